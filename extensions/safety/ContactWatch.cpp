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

// A tick can interrupt this function between two statements. If a tick after the first statement
// records an opening, this call and the next call both report the opening. If the contact closes
// after the second statement, a tick can record this closing before the third statement. The third
// statement deletes this record. In this case the openings before and after this closing count as
// one.
bool ContactWatch::opened() {
  const bool before = latched_.exchange(false, std::memory_order_relaxed);
  const bool open = contact_.level();
  closed_.store(!open, std::memory_order_relaxed);
  return open || before;
}

}  // namespace wr
