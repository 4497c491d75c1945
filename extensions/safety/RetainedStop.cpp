#include "safety/RetainedStop.hpp"

namespace wr {

namespace {

// The two values differ in all bits. If all bits of the memory are 0, or all bits are 1, the memory
// contains neither value.
constexpr std::uint32_t kStopped = 0x5AC3'3C69;
constexpr std::uint32_t kReleased = 0xA53C'C396;

}  // namespace

RetainedStop::RetainedStop(Cells& cells) : cells_(cells) {}

void RetainedStop::begin(ResetCause cause) {
  if (cause == ResetCause::PowerOn) {
    save(false);
  }
}

bool RetainedStop::stopped() const {
  return cells_.value != kReleased || cells_.check != ~kReleased;
}

void RetainedStop::save(bool stopped) {
  cells_.value = stopped ? kStopped : kReleased;
  cells_.check = ~cells_.value;
}

}  // namespace wr
