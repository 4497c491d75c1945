#pragma once

#include "wheel_control/orders/WheelOrder.hpp"

namespace wr {

/// @brief Executes the order to follow the set-point; a set-point of less than 0.5 V counts as 0.
///
/// At such a voltage the motor does not turn; it only gets warm.
class ApplyAboveThreshold final : public WheelOrder {
 public:
  /// @brief Least magnitude of a voltage that is followed [mV].
  static constexpr std::int16_t kLeast = 500;

  /// @brief Binds the order to the order that follows the set-point.
  /// @param apply order that follows the set-point
  explicit ApplyAboveThreshold(WheelOrder& apply) : apply_(apply) {}

  /// @brief Replaces a set-point that is too low by 0, then follows it.
  /// @param work contains the set-point; receives the values of the executed order
  /// @isr{no}
  void execute(WheelWork& work) override {
    const bool low = work.setPoint.quantity == WheelQuantity::Tension &&
                     work.setPoint.value > -kLeast && work.setPoint.value < kLeast;
    if (low) {
      work.setPoint.value = 0;
    }
    apply_.execute(work);
  }

 private:
  WheelOrder& apply_;
};

}  // namespace wr
