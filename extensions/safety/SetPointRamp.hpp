#pragma once

#include <array>
#include <cstdint>

#include "safety/OrderStageDecorator.hpp"
#include "units/Measurements.hpp"
#include "units/SetPoints.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Limits the acceleration and the speed of the robot.
///
/// @function Changes the set-points of velocity towards the ordered set-points by at most 0.5
/// m/s^2, and the set-points of voltage by at most 1.0 V per cycle. The greatest velocity falls
/// with the steering angle. The wheels share one factor, so that the ratio of their velocities
/// stays as ordered. While a wheel is too fast, the set-points of all wheels are lowered by another
/// factor.
///
/// @secret How far a set-point changes in a cycle, how fast a curve may be driven, and how a robot that is too
/// fast slows down.
class SetPointRamp final : public OrderStageDecorator {
 public:
  /// @brief Binds the ramp to the robot.
  /// @param wrapped control system that follows the limited set-points
  explicit SetPointRamp(OrderStage& wrapped);

  /// @brief Forwards limited set-points.
  /// @param setPoints set-points of the cycle
  /// @param cycle number of the cycle
  /// @satisfies FR-282
  /// @satisfies FR-294
  /// @satisfies FR-295
  /// @isr{no}
  void follow(const SetPoints& setPoints, std::uint32_t cycle) override;

  /// @brief Holds the robot; the next ramp begins at 0.
  /// @param cycle number of the cycle
  /// @satisfies FR-282
  /// @isr{no}
  void stand(std::uint32_t cycle) override;

  /// @brief Acknowledges; the next ramp begins at 0.
  /// @param cycle number of the cycle
  /// @satisfies FR-282
  /// @isr{no}
  void recover(std::uint32_t cycle) override;

 private:
  void followMeasured(const SetPoints& setPoints, const Measurements& measurements,
                      const Outputs& outputs);
  void lowerWhenFast(const Measurements& measurements, std::int32_t most);
  void limit(SetPoints& setPoints, std::int32_t most) const;
  [[nodiscard]] std::int32_t greatestChange(const SetPoints& setPoints) const;

  Measurements measurements_;  // measurements of the present cycle
  Outputs outputs_;
  std::array<std::int32_t, kWheelCount> ramped_{};      // [0.1 rpm] set-point of each wheel
  std::array<std::int32_t, kWheelCount> velocities_{};  // [0.1 rpm] magnitudes of the previous
                                                        // cycle
  std::int32_t share_ = 1000;                           // [0.001] factor of the ordered set-points
};

}  // namespace wr
