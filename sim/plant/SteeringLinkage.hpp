#pragma once

#include <array>
#include <cstddef>

#include "sim/plant/Plant.hpp"

namespace wr::plant {

/// @brief Position and direction of a wheel.
struct WheelPose {
  double x = 0;       ///< m in front of the middle of the robot
  double y = 0;       ///< m to the left of the middle of the robot
  double cosine = 1;  ///< cosine of the wheel's angle to the left
  double sine = 0;
};

/// @brief The poses of the four wheels: front left, front right, rear left and rear right. All
/// wheels move on circles around one point on the line of the rear axle (Ackermann steering).
class SteeringLinkage {
 public:
  static constexpr double kWheelbase = 1.582;  ///< value in the robot's public description [m]
  static constexpr double kTrack = 1.054;      ///< value in the robot's public description [m]

  SteeringLinkage() { turn(0); }

  /// @brief Turns the front wheels.
  /// @param degrees angle that a wheel in the middle of the front axle would have, positive to the
  /// left
  void turn(double degrees);

  /// @brief Returns the pose of a wheel.
  /// @param wheel 0 to 3
  [[nodiscard]] const WheelPose& pose(std::size_t wheel) const { return poses_[wheel]; }

 private:
  double degrees_ = 1;
  std::array<WheelPose, kWheels> poses_{};
};

}  // namespace wr::plant
