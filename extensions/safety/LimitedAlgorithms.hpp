#pragma once

#include <array>

#include "safety/SpeedLimited.hpp"
#include "wheel_control/algorithms/CurrentAlgorithm.hpp"
#include "wheel_control/algorithms/TensionAlgorithm.hpp"
#include "wheel_control/algorithms/VelocityAlgorithm.hpp"

namespace wr {

/// @brief The algorithms of a wheel whose orders of voltage and current end at the speed limit.
/// @datatype
struct LimitedAlgorithms {
  VelocityAlgorithm velocity;                          ///< for orders of velocity
  TensionAlgorithm tension;                            ///< for orders of voltage
  CurrentAlgorithm current;                            ///< for orders of current
  VelocityAlgorithm tensionLimit;                      ///< speed limit of orders of voltage
  VelocityAlgorithm currentLimit;                      ///< speed limit of orders of current
  SpeedLimited limitedTension{tension, tensionLimit};  ///< orders of voltage, limited
  SpeedLimited limitedCurrent{current, currentLimit};  ///< orders of current, limited

  /// @brief Returns the algorithm of each quantity, in the sequence of WheelQuantity.
  /// @return algorithms of velocity, voltage and current.
  /// @isr{no}
  [[nodiscard]] std::array<WheelAlgorithm*, 3> all() {
    return {&velocity, &limitedTension, &limitedCurrent};
  }
};

}  // namespace wr
