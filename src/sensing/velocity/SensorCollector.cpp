#include "sensing/velocity/SensorCollector.hpp"

#include <array>
#include <limits>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

// Direction of an edge, by the levels before and after it; 0 when none or both changed.
constexpr std::array<std::array<std::int8_t, 4>, 4> kDirections = {{
    {0, 1, -1, 0},
    {-1, 0, 0, 1},
    {1, 0, 0, -1},
    {0, -1, 1, 0},
}};

// Time between two edges at the greatest velocity [us]: 2222. A velocity is in 0.1 rpm.
constexpr Microseconds kLeastGap(600'000'000 /
                                 (std::int64_t{SensorCollector::kGreatestVelocity.count()} *
                                  SystemConstants::instance().hallEdgesPerTurn()));

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
  if (plausible(direction, at)) {
    direction_ = direction;
    last_ = at;
    instants_.collect({at, rising, direction});
  } else if (newest_.rejected < std::numeric_limits<std::uint16_t>::max()) {
    ++newest_.rejected;
  }
  instants_.fill(newest_.instants);
  record_.write(newest_, at);
}

HallRecord SensorCollector::record() {
  const Stamped<HallRecord>* const newest = record_.newest();
  return newest != nullptr ? newest->value : HallRecord();
}

bool SensorCollector::plausible(std::int8_t direction, Instant at) const {
  return direction != 0 && (direction != direction_ || at - last_ >= kLeastGap);
}

}  // namespace wr
