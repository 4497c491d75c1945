#include "safety/RetainedProtection.hpp"

#include "units/SetPoints.hpp"

namespace wr {

namespace {

// Bit pattern of valid content. If all bits of the memory are 0, or all bits are 1, the memory does
// not contain this pattern.
constexpr std::uint32_t kRetainedMark = 0x96C3'0000;
constexpr std::uint32_t kMarkBits = 0xFFFF'0000;
constexpr std::uint32_t kByte = 0xFF;
constexpr unsigned kCauseShift = 8;

constexpr RetainedProtection::Stop kDoubtful{.cause = StopCause::MissingMeasurement};

std::uint32_t encoded(const RetainedProtection::Stop& stop) {
  return kRetainedMark | static_cast<std::uint32_t>(stop.cause) << kCauseShift | stop.wheel;
}

bool possible(std::uint32_t cause, std::uint32_t wheel) {
  return cause <= static_cast<std::uint32_t>(StopCause::ClockLost) &&
         (wheel < kWheelCount || wheel == Protection::kNoWheel);
}

}  // namespace

RetainedProtection::RetainedProtection(Cells& cells) : cells_(cells) {}

void RetainedProtection::begin(const StartRecord& start) {
  const bool clockLost =
      start.cause == ResetCause::ClockLost || start.fault == FaultKind::ClockFailed;
  if (start.cause == ResetCause::PowerOn) {
    save({});
  } else if (clockLost && stored() == Stop()) {
    save({.cause = StopCause::ClockLost});
  }
}

RetainedProtection::Stop RetainedProtection::stored() const {
  const std::uint32_t value = cells_.value;
  const std::uint32_t cause = value >> kCauseShift & kByte;
  const std::uint32_t wheel = value & kByte;
  if (cells_.check != ~value || (value & kMarkBits) != kRetainedMark || !possible(cause, wheel)) {
    return kDoubtful;
  }
  return {.cause = static_cast<StopCause>(cause), .wheel = static_cast<std::uint8_t>(wheel)};
}

void RetainedProtection::save(const Stop& stop) {
  cells_.value = encoded(stop);
  cells_.check = ~cells_.value;
}

}  // namespace wr
