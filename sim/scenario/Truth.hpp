#pragma once

#include <string_view>
#include <vector>

#include "sim/robot/Robot.hpp"

namespace wr {

/// @brief A value of the simulated robot itself, which no sensor tells.
struct TruthField {
  std::string_view name;
  /// Reads the value, in the unit of the protocol where the protocol has such a value. The mark is
  /// the distance [m] from which ways are counted.
  double (*valueOf)(const sim::Robot& robot, double mark);
};

/// @brief All true values that have a name in scenarios: true_velocity0 to 3 [0.1 rpm],
/// true_current0 to 3 [mA], true_steering [0.01 degree], ground_speed [mm/s], distance [mm], way
/// since the mark [mm], slope [percent].
/// @return the fields
[[nodiscard]] const std::vector<TruthField>& truthFields();

/// @brief Finds a true value by its name.
/// @param name the name
/// @return the field; null if there is none
[[nodiscard]] const TruthField* findTruth(std::string_view name);

}  // namespace wr
