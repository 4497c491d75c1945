#include "sim/scenario/Truth.hpp"

#include <algorithm>
#include <cstddef>

namespace wr {

namespace {

using sim::Robot;

template <std::size_t wheel>
double velocity(const Robot& robot, double /*mark*/) {
  return robot.velocityRpm(wheel) * 10;
}

template <std::size_t wheel>
double current(const Robot& robot, double /*mark*/) {
  return robot.currentAmperes(wheel) * 1000;
}

double steering(const Robot& robot, double /*mark*/) {
  return robot.steeringDegrees() * 100;
}

double groundSpeed(const Robot& robot, double /*mark*/) {
  return robot.groundSpeed() * 1000;
}

double distance(const Robot& robot, double /*mark*/) {
  return robot.distance() * 1000;
}

double way(const Robot& robot, double mark) {
  return (robot.distance() - mark) * 1000;
}

double slope(const Robot& robot, double /*mark*/) {
  return robot.slope();
}

}  // namespace

const std::vector<TruthField>& truthFields() {
  static const std::vector<TruthField> fields{
      {"true_velocity0", velocity<0>},
      {"true_velocity1", velocity<1>},
      {"true_velocity2", velocity<2>},
      {"true_velocity3", velocity<3>},
      {"true_current0", current<0>},
      {"true_current1", current<1>},
      {"true_current2", current<2>},
      {"true_current3", current<3>},
      {"true_steering", steering},
      {"ground_speed", groundSpeed},
      {"distance", distance},
      {"way", way},
      {"slope", slope},
  };
  return fields;
}

const TruthField* findTruth(std::string_view name) {
  const std::vector<TruthField>& fields = truthFields();
  const auto found = std::ranges::find(fields, name, &TruthField::name);
  return found != fields.end() ? &*found : nullptr;
}

}  // namespace wr
