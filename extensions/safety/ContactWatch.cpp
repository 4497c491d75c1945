#include "safety/ContactWatch.hpp"

namespace wr {

namespace {

constexpr std::uint8_t kTicks = 3;  // [ms]

}  // namespace

ContactWatch::ContactWatch(const EdgeInput& contact) : contact_(contact) {}

void ContactWatch::sample() {
  if (!contact_.level()) {
    openTicks_ = 0;
    closed_.store(true, std::memory_order_relaxed);
    return;
  }
  if (openTicks_ < kTicks) {
    ++openTicks_;
  }
  if (openTicks_ == kTicks && closed_.load(std::memory_order_relaxed)) {
    latched_.store(true, std::memory_order_relaxed);
  }
}

// If a tick comes between two of these statements, an opening is reported twice, but none is lost.
bool ContactWatch::opened() {
  const bool before = latched_.exchange(false, std::memory_order_relaxed);
  const bool open = contact_.level();
  closed_.store(!open, std::memory_order_relaxed);
  return open || before;
}

}  // namespace wr
