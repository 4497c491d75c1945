#include "sensing/velocity/SensorCollector.hpp"

#include <array>

namespace wr {

namespace {

// Direction of an edge. The first index contains the levels before the edge. The second index
// contains the levels after the edge. The direction is 0 if no level or both levels changed.
constexpr std::array<std::array<std::int8_t, 4>, 4> kDirections = {{
    {0, 1, -1, 0},
    {-1, 0, 0, 1},
    {1, 0, 0, -1},
    {0, -1, 1, 0},
}};

// A turning wheel needs more than this time to pass an edge, stop, and pass the same edge
// backwards.
constexpr Microseconds kMinReversalTime = milliseconds(25);

}  // namespace

SensorCollector::SensorCollector(InstantCollector& instants) : instants_(instants) {}

void SensorCollector::collect(std::uint8_t phase, Instant at) {
  if (!phase_) {
    phase_ = phase;
    return;
  }
  const std::int8_t direction = kDirections[*phase_][phase];
  const bool rising = phase > *phase_;
  phase_ = phase;
  if (direction != 0) {
    step(direction, rising, at);
  } else {
    ++newest_.unclear;
  }
  instants_.fill(newest_.instants);
  record_.write(newest_, at);
}

const HallRecord& SensorCollector::record() {
  static constexpr HallRecord kEmpty{};
  const Stamped<HallRecord>* const newest = record_.newest();
  return newest != nullptr ? newest->value : kEmpty;
}

void SensorCollector::step(std::int8_t direction, bool rising, Instant at) {
  if (direction + direction_ == 0 && at - last_ < kMinReversalTime) {
    ++newest_.reversals;
  }
  direction_ = direction;
  last_ = at;
  instants_.collect({at, rising, direction});
}

}  // namespace wr
