#include "sim/plant/HallSensors.hpp"

#include <algorithm>
#include <cmath>

#include "sim/plant/floorToInt.hpp"

namespace wr::plant {

namespace {

// At the start, the shaft is in the middle between two edges.
constexpr double kStart = 0.5;

// Returns the level of a sensor at a position. The position is the number of edges since a rising
// edge of this sensor. A period has four edges. The level is high from position 0 to 2, and low
// from 2 to 4. Sensor a is high from edge 1 to edge 3, and sensor b is high from edge 2 to edge 4.
bool levelAt(double position) {
  return (wholePart(position) & 2) == 0;
}

}  // namespace

std::optional<double> HallSensors::turn(std::size_t sensor, double from, double to) {
  if (from == to) {
    return std::nullopt;
  }
  const double shift = kStart + misplaced_.at(sensor) - 1.0 - static_cast<double>(sensor);
  const double position = to * kEdgesPerTurn + shift;
  const bool level = levelAt(position - kHysteresis);
  if (level == levels_.at(sensor) || level != levelAt(position + kHysteresis)) {
    return std::nullopt;
  }
  levels_.at(sensor) = level;
  const double edge = to > from ? 2.0 * std::floor((position - kHysteresis) / 2.0) + kHysteresis
                                : 2.0 * std::ceil((position + kHysteresis) / 2.0) - kHysteresis;
  const double before = from * kEdgesPerTurn + shift;
  return std::clamp((edge - before) / (position - before), 0.0, 1.0);
}

}  // namespace wr::plant
