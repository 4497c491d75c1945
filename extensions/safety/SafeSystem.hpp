#pragma once

#include <cstdint>

#include "main_control/control_systems/ControlSystem.hpp"
#include "safety/OrderStage.hpp"
#include "units/SetPoints.hpp"

namespace wr {

/// @brief The robot and its safety functions, together as a single control system.
///
/// @function Receives the order of a cycle in several calls, and passes it to the first stage in
/// one call. There are three orders: follow set-points, stand still, or acknowledge faults.
///
/// @secret The rule by which the calls of one order are combined into one call.
///
/// @role{control-system-orders, Concrete Class}
class SafeSystem final : public ControlSystem {
 public:
  /// @param first stage that receives each order first
  explicit SafeSystem(OrderStage& first);

  /// @brief Checks whether every control system of the robot has executed the orders of a cycle.
  /// @param cycle number of the cycle
  /// @return true if all control systems have executed the orders.
  /// @satisfies FR-293
  /// @isr{no}
  [[nodiscard]] bool completed(std::uint32_t cycle) const override;

  /// @brief Writes the measurements and outputs of the robot, and the state of its safety
  /// functions.
  /// @param measurements receives the measurements
  /// @param outputs receives the outputs
  /// @satisfies FR-281
  /// @satisfies FR-293
  /// @isr{no}
  void collect(Measurements& measurements, Outputs& outputs) const override;

 private:
  enum class Order : std::uint8_t { Follow, Hold, Acknowledge };

  void measure() override;
  void apply(const SetPoints& setPoints) override;
  void halt() override;
  void release() override;
  /// @brief Passes the recorded order to the first stage.
  /// @param cycle number of the cycle
  /// @satisfies FR-293
  void activate(std::uint32_t cycle) override;

  OrderStage& first_;
  SetPoints setPoints_{};
  Order order_ = Order::Hold;
};

}  // namespace wr
