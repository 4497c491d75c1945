#include "safety/ContactWatch.hpp"

namespace wr {

namespace {

constexpr std::uint8_t kTicks = 3;  // [ms]

}  // namespace

ContactWatch::ContactWatch(const EdgeInput& contact) : contact_(contact) {}

void ContactWatch::sample() {
  if (!contact_.level()) {
    openTicks_ = 0;
  } else if (openTicks_ < kTicks) {
    ++openTicks_;
  }
  if (openTicks_ == kTicks) {
    latched_.store(true, std::memory_order_relaxed);
  }
}

bool ContactWatch::open() const {
  return contact_.level();
}

bool ContactWatch::opened() {
  const bool before = latched_.exchange(false, std::memory_order_relaxed);
  return contact_.level() || before;
}

}  // namespace wr
