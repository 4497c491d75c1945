#pragma once

#include <cstdint>

#include "safety/OrderStageDecorator.hpp"

namespace wr {

/// @brief A stage that lets a source of orders move the robot only after neutral orders.
///
/// @function Counts neutral orders: orders whose set-points are 0 for all wheels. An order counts
/// only in the cycle in which it is read. After five neutral orders without another order between
/// them, forwards all set-points. Until then, halts the wheels and holds the steering. Each halt
/// that the previous stage demands, and each acknowledgement, start the count again.
///
/// @secret The orders that are neutral, and the number of neutral orders that a source must send
/// before it may move the robot.
class Arming final : public OrderStageDecorator {
 public:
  /// @param wrapped stage that receives the forwarded orders
  explicit Arming(OrderStage& wrapped);

  /// @brief Writes the measurements and outputs of the robot, and whether orders may move the
  /// robot.
  /// @param measurements receives the measurements
  /// @param outputs receives the outputs
  /// @satisfies FR-281
  /// @isr{no}
  void collect(Measurements& measurements, Outputs& outputs) const override;

  /// @brief Forwards the set-points if enough neutral orders were read. Otherwise halts the wheels,
  /// holds the steering, and updates the count of neutral orders.
  /// @param setPoints set-points of the cycle
  /// @param cycle number of the cycle
  /// @satisfies FR-280
  /// @isr{no}
  void follow(const SetPoints& setPoints, std::uint32_t cycle) override;

  /// @brief Halts the wheels, holds the steering, and starts the count of neutral orders again.
  /// @param cycle number of the cycle
  /// @satisfies FR-280
  /// @isr{no}
  void stand(std::uint32_t cycle) override;

  /// @brief Forwards the acknowledgement, and starts the count of neutral orders again.
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
