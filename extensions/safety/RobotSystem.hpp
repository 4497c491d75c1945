#pragma once

#include <cstdint>

#include "main_control/control_systems/ControlSystemPool.hpp"
#include "safety/OrderedSystem.hpp"

namespace wr {

/// @brief All control systems of the robot as one control system.
///
/// @function Passes each order on to every control system of the robot, so that a decorator can wrap all of
/// them at once.
///
/// @secret That one control system stands for several.
class RobotSystem final : public OrderedSystem {
 public:
  /// @brief Binds the system to the pool.
  /// @param pool control systems of the robot
  explicit RobotSystem(ControlSystemPool& pool);

  /// @brief Checks whether every control system of the robot has carried out the orders of a cycle.
  /// @param cycle number of the cycle
  /// @return true if all have.
  /// @satisfies FR-293
  /// @isr{no}
  [[nodiscard]] bool completed(std::uint32_t cycle) const override;

  /// @brief Adds the measurements and outputs of every control system of the robot.
  /// @param measurements receives the measurements
  /// @param outputs receives the outputs
  /// @satisfies FR-293
  /// @isr{no}
  void collect(Measurements& measurements, Outputs& outputs) const override;

 private:
  void follow(const SetPoints& setPoints, std::uint32_t cycle) override;
  void stand(std::uint32_t cycle) override;
  void recover(std::uint32_t cycle) override;

  ControlSystemPool& pool_;
};

}  // namespace wr
