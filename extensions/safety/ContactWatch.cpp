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

// A tick can interrupt this function between two statements. If a tick between the first and the
// third statement records an opening, this call and the next call both report this opening. If the
// contact closes after the second statement, a tick can record the closing before the third
// statement is executed. The third statement then deletes this record, and the openings before and
// after the closing count as one opening.
bool ContactWatch::opened() {
  const bool before = latched_.exchange(false, std::memory_order_relaxed);
  const bool open = contact_.level();
  closed_.store(!open, std::memory_order_relaxed);
  return open || before;
}

}  // namespace wr
