#include "safety/EnableBuffer.hpp"

#include "safety/EnableSwitch.hpp"

namespace wr {

namespace {

constexpr std::int32_t kMiddlePulse = 1500;    // [us]
constexpr std::int32_t kFullDeflection = 500;  // [us] deflection of a pulse of 2000 us

// Longest valid pulse of the enable switch. A pulse out of the valid range orders a stop.
constexpr Microseconds kLongestPulse(2100);

bool inRange(Microseconds width) {
  return width >= EnableSwitch::kShortestPulse && width <= kLongestPulse;
}

}  // namespace

EnableBuffer::EnableBuffer(InstantCollector& instants, const Function& function,
                           Pipe<Microseconds>& width, Pipe<Microseconds>& stop)
    : RcBuffer(instants, function), pipe_(width), stop_(stop) {}

std::int32_t EnableBuffer::fullDeflection() const {
  return kFullDeflection;
}

void EnableBuffer::keep(std::int32_t value, Instant at) {
  const Microseconds width(kMiddlePulse + value);
  if (inRange(width)) {
    pipe_.write(width, at);
  }
  const bool stops = !inRange(width) || width < EnableSwitch::kMinNoStopPulse;
  if (stops && stopBefore_) {
    stop_.write(width, at);
  }
  stopBefore_ = stops;
}

}  // namespace wr
