#pragma once

#include <array>

#include "safety/CurrentLimited.hpp"
#include "safety/SpeedLimited.hpp"
#include "wheel_control/algorithms/CurrentAlgorithm.hpp"
#include "wheel_control/algorithms/TensionAlgorithm.hpp"
#include "wheel_control/algorithms/VelocityAlgorithm.hpp"

namespace wr {

/// @brief The algorithms of a wheel, with their limits.
/// @datatype
struct LimitedAlgorithms {
  VelocityAlgorithm velocity;                  ///< algorithm for orders of velocity
  TensionAlgorithm tension;                    ///< algorithm for orders of voltage
  CurrentAlgorithm current;                    ///< algorithm for orders of current
  SpeedLimited slowTension{tension};           ///< orders of voltage, limited at the speed limit
  SpeedLimited slowCurrent{current};           ///< orders of current, limited at the speed limit
  CurrentLimited limitedVelocity{velocity};    ///< orders of velocity, limited
  CurrentLimited limitedTension{slowTension};  ///< orders of voltage, limited
  CurrentLimited limitedCurrent{slowCurrent};  ///< orders of current, limited

  /// @brief Returns the algorithm of each quantity, in the order of WheelQuantity.
  /// @return limited algorithms of velocity, voltage and current.
  /// @isr{no}
  [[nodiscard]] std::array<WheelAlgorithm*, 3> all() {
    return {&limitedVelocity, &limitedTension, &limitedCurrent};
  }
};

}  // namespace wr
