#pragma once

#include "wheel_control/orders/WheelOrder.hpp"

namespace wr {

/// @brief A wheel order that follows the set-point. If the set-point is a voltage between -0.5 V
/// and 0.5 V, the wheel order uses 0 V instead.
///
/// At such a low voltage, the motor does not turn, but becomes warm.
class ApplyAboveThreshold final : public WheelOrder {
 public:
  /// @brief A voltage is replaced by 0 if its magnitude is less than this value [mV].
  static constexpr std::int16_t kLeast = 500;

  /// @param apply extended wheel order, which follows the set-point
  explicit ApplyAboveThreshold(WheelOrder& apply) : apply_(apply) {}

  /// @brief If the set-point is a voltage between -0.5 V and 0.5 V, sets the set-point to 0. Then
  /// executes the extended wheel order.
  /// @param work contains the set-point; receives the values that the extended wheel order writes
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
