#pragma once

#include <string_view>
#include <vector>

#include "sim/plant/Robot.hpp"

namespace wr::scenario {

/// @brief A true value of the simulated robot. It does not contain the errors of the sensors.
struct TruthField {
  std::string_view name;
  /// Reads the value. If a field of the protocol contains a measurement of this value, the field
  /// has the same unit. `mark` is the distance of the robot [m] at which the measurement of `way`
  /// began.
  double (*valueOf)(const plant::Robot& robot, double mark);
};

/// @brief Returns all true values that have a name in scenarios: true_velocity0 to 3 [0.1 rpm],
/// true_current0 to 3 [mA], true_steering [0.01 degree], ground_speed [mm/s], distance [mm], way
/// (distance since the mark) [mm], slope [percent], max_velocity (greatest velocity of any wheel
/// since the mark) [0.1 rpm], braking (1 while no driver puts power into its motor), yaw_rate [0.01
/// degree/s], heading [0.01 degree], radius (of the curve) [mm, at most 1 km], supply [mV], torque0
/// to 3 (of the motors) [mN m], side_slip0 to 3 (speed at which the tyres slide sideways) [mm/s].
[[nodiscard]] const std::vector<TruthField>& truthFields();

/// @brief Finds a true value by its name.
/// @param name the name
/// @return the field; null if there is no such field
[[nodiscard]] const TruthField* findTruth(std::string_view name);

}  // namespace wr::scenario
