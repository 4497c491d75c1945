#pragma once

#include <cstdint>

#include "safety/OrderStageDecorator.hpp"

namespace wr {

/// @brief Lets orders move the robot only after neutral orders.
///
/// @function Holds the robot until the orders of five successive cycles had 0 as the set-point of
/// all wheels, then forwards set-points. An order from an earlier cycle that is still in force does
/// not count. Every hold and every acknowledgement withdraws the permission to move the robot.
///
/// @secret Which set-points are neutral, and for how long a source has to order them.
class Arming final : public OrderStageDecorator {
 public:
  /// @brief Binds the permission to the robot.
  /// @param wrapped control system that gets the set-points
  explicit Arming(OrderStage& wrapped);

  /// @brief Adds the measurements and outputs of the robot, and the permission to move it.
  /// @param measurements receives the measurements
  /// @param outputs receives the outputs
  /// @satisfies FR-281
  /// @isr{no}
  void collect(Measurements& measurements, Outputs& outputs) const override;

  /// @brief Holds the robot until the set-points were neutral for long enough, then forwards them.
  /// @param setPoints set-points of the cycle
  /// @param cycle number of the cycle
  /// @satisfies FR-280
  /// @isr{no}
  void follow(const SetPoints& setPoints, std::uint32_t cycle) override;

  /// @brief Holds the robot, and withdraws the permission.
  /// @param cycle number of the cycle
  /// @satisfies FR-280
  /// @isr{no}
  void stand(std::uint32_t cycle) override;

  /// @brief Acknowledges, and withdraws the permission.
  /// @param cycle number of the cycle
  /// @satisfies FR-280
  /// @isr{no}
  void recover(std::uint32_t cycle) override;

 private:
  void disarm();
  [[nodiscard]] bool armed() const;

  std::uint8_t neutralOrders_ = 0;  // number of successive neutral orders
};

}  // namespace wr
