#pragma once

#include <array>

#include "safety/CurrentLimited.hpp"
#include "safety/SpeedLimited.hpp"
#include "wheel_control/algorithms/CurrentAlgorithm.hpp"
#include "wheel_control/algorithms/TensionAlgorithm.hpp"
#include "wheel_control/algorithms/VelocityAlgorithm.hpp"

namespace wr {

/// @brief The control algorithms of one wheel, and the limits that wrap them.
/// @datatype
struct LimitedAlgorithms {
  VelocityAlgorithm velocity;                  ///< algorithm for orders of velocity
  TensionAlgorithm tension;                    ///< algorithm for orders of voltage
  CurrentAlgorithm current;                    ///< algorithm for orders of current
  SpeedLimited slowTension{tension};           ///< limits the speed during orders of voltage
  SpeedLimited slowCurrent{current};           ///< limits the speed during orders of current
  CurrentLimited limitedVelocity{velocity};    ///< limits the current during orders of velocity
  CurrentLimited limitedTension{slowTension};  ///< limits the current during orders of voltage
  CurrentLimited limitedCurrent{slowCurrent};  ///< limits the current during orders of current

  /// @brief Returns the limited algorithm for each quantity, in the sequence of WheelQuantity.
  /// @return limited algorithms for velocity, voltage and current.
  /// @isr{no}
  [[nodiscard]] std::array<WheelAlgorithm*, 3> all() {
    return {&limitedVelocity, &limitedTension, &limitedCurrent};
  }
};

}  // namespace wr
