#include "sim/scenario/GroundTruth.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace wr::scenario {

namespace {

using plant::Robot;

constexpr double kDegree = 180.0 / std::numbers::pi;  // degrees per radian
constexpr double kStraight = 1000;                    // m

template <std::size_t wheel>
double velocity(const Robot& robot, double /*mark*/) {
  return robot.velocityRpm(wheel) * 10;
}

template <std::size_t wheel>
double current(const Robot& robot, double /*mark*/) {
  return robot.currentAmperes(wheel) * 1000;
}

template <std::size_t wheel>
double torque(const Robot& robot, double /*mark*/) {
  return robot.torque(wheel) * 1000;
}

template <std::size_t wheel>
double sideSlip(const Robot& robot, double /*mark*/) {
  return robot.sideSlip(wheel) * 1000;
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

double greatestVelocity(const Robot& robot, double /*mark*/) {
  return robot.greatestRpm() * 10;
}

double braking(const Robot& robot, double /*mark*/) {
  return robot.braking() ? 1 : 0;
}

double yawRate(const Robot& robot, double /*mark*/) {
  return robot.yawRate() * kDegree * 100;
}

double heading(const Robot& robot, double /*mark*/) {
  return robot.heading() * kDegree * 100;
}

// If the robot drives straight ahead, the returned radius is 1 km.
double radius(const Robot& robot, double /*mark*/) {
  const double speed = robot.groundSpeed();
  const double yaw = robot.yawRate();
  if (std::abs(yaw) * kStraight <= std::abs(speed)) {
    return std::copysign(kStraight * 1000, yaw);
  }
  return speed / yaw * 1000;
}

double supply(const Robot& robot, double /*mark*/) {
  return robot.supplyVolts() * 1000;
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
      {"max_velocity", greatestVelocity},
      {"braking", braking},
      {"yaw_rate", yawRate},
      {"heading", heading},
      {"radius", radius},
      {"supply", supply},
      {"torque0", torque<0>},
      {"torque1", torque<1>},
      {"torque2", torque<2>},
      {"torque3", torque<3>},
      {"side_slip0", sideSlip<0>},
      {"side_slip1", sideSlip<1>},
      {"side_slip2", sideSlip<2>},
      {"side_slip3", sideSlip<3>},
  };
  return fields;
}

const TruthField* findTruth(std::string_view name) {
  const std::vector<TruthField>& fields = truthFields();
  const auto found = std::ranges::find(fields, name, &TruthField::name);
  return found != fields.end() ? &*found : nullptr;
}

}  // namespace wr::scenario
