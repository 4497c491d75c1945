#pragma once

#include <cstdint>

#include "safety/OrderStage.hpp"

namespace wr {

/// @brief A stage that extends another stage.
///
/// @function Forwards the calls of completed() and collect() to the wrapped stage. A subclass can
/// change an order before it forwards the order.
///
/// @secret The calls that are forwarded to the wrapped stage without a change.
class OrderStageDecorator : public OrderStage {
 public:
  /// @brief Checks whether the wrapped stage has executed the orders of a cycle.
  /// @param cycle number of the cycle
  /// @return true if the wrapped stage has executed the orders.
  /// @satisfies FR-293
  /// @isr{no}
  [[nodiscard]] bool completed(std::uint32_t cycle) const override;

  /// @brief Writes the measurements and outputs of the wrapped stage.
  /// @param measurements receives the measurements
  /// @param outputs receives the outputs
  /// @satisfies FR-293
  /// @isr{no}
  void collect(Measurements& measurements, Outputs& outputs) const override;

 protected:
  /// @param wrapped the extended stage
  explicit OrderStageDecorator(OrderStage& wrapped);
  ~OrderStageDecorator() = default;

  /// @brief Returns the wrapped stage.
  /// @return stage that receives the forwarded orders.
  /// @isr{no}
  [[nodiscard]] OrderStage& wrapped() const;

 private:
  OrderStage& wrapped_;
};

}  // namespace wr
