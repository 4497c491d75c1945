#pragma once

#include <cstdint>

#include "safety/OrderStage.hpp"

namespace wr {

/// @brief A stage that extends another stage.
///
/// @function Forwards each operation to the wrapped stage, unless a subclass extends it. Subclasses
/// change the orders that they extend.
///
/// @secret Which calls of the wrapped stage are forwarded unchanged.
class OrderStageDecorator : public OrderStage {
 public:
  /// @brief Checks whether the wrapped stage has carried out the orders of a cycle.
  /// @param cycle number of the cycle
  /// @return true if it has carried them out.
  /// @satisfies FR-293
  /// @isr{no}
  [[nodiscard]] bool completed(std::uint32_t cycle) const override;

  /// @brief Adds the measurements and outputs of the wrapped stage.
  /// @param measurements receives the measurements
  /// @param outputs receives the outputs
  /// @satisfies FR-293
  /// @isr{no}
  void collect(Measurements& measurements, Outputs& outputs) const override;

 protected:
  /// @brief Binds the decorator to the stage that it extends.
  /// @param wrapped the extended stage
  explicit OrderStageDecorator(OrderStage& wrapped);
  ~OrderStageDecorator() = default;

  /// @brief Returns the wrapped stage.
  /// @return stage that the decorator extends.
  /// @isr{no}
  [[nodiscard]] OrderStage& wrapped() const;

 private:
  OrderStage& wrapped_;
};

}  // namespace wr
