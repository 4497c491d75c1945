#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "main_control/control_systems/ControlSystem.hpp"
#include "safety/OrderStage.hpp"

namespace wr {

/// @brief The last stage that each order passes.
///
/// @function Forwards each order to every control system of the robot. Therefore the earlier stages
/// do not depend on the number of control systems.
///
/// @secret The number of control systems that receive an order.
class RobotStage final : public OrderStage {
 public:
  /// @brief Greatest number of control systems.
  static constexpr std::size_t kCapacity = 8;

  /// @brief Constructs the stage without control systems.
  RobotStage() = default;

  /// @brief Adds a control system.
  /// @param system control system of the robot; it must exist as long as this object
  /// @errors If the stage already has kCapacity control systems, the program ends with the
  /// assertion PoolFull.
  /// @satisfies FR-293
  /// @isr{no}
  void add(ControlSystem& system);

  /// @brief Checks whether every control system of the robot has executed the orders of a cycle.
  /// @param cycle number of the cycle
  /// @return true if all control systems have executed the orders.
  /// @satisfies FR-293
  /// @isr{no}
  [[nodiscard]] bool completed(std::uint32_t cycle) const override;

  /// @brief Writes the measurements and outputs of every control system of the robot.
  /// @param measurements receives the measurements
  /// @param outputs receives the outputs
  /// @satisfies FR-293
  /// @isr{no}
  void collect(Measurements& measurements, Outputs& outputs) const override;

  /// @brief Orders every control system to follow set-points.
  /// @param setPoints set-points of the cycle
  /// @param cycle number of the cycle
  /// @satisfies FR-293
  /// @isr{no}
  void follow(const SetPoints& setPoints, std::uint32_t cycle) override;

  /// @brief Orders the wheels to halt and the steering to hold its angle.
  /// @param cycle number of the cycle
  /// @satisfies FR-293
  /// @isr{no}
  void stand(std::uint32_t cycle) override;

  /// @brief Orders every control system to release its latched faults, and to stand still in this
  /// cycle.
  /// @param cycle number of the cycle
  /// @satisfies FR-293
  /// @isr{no}
  void recover(std::uint32_t cycle) override;

 private:
  [[nodiscard]] std::span<ControlSystem* const> systems() const;

  std::array<ControlSystem*, kCapacity> systems_{};
  std::size_t count_ = 0;
};

}  // namespace wr
