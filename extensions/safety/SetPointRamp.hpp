#pragma once

#include <array>
#include <cstdint>

#include "safety/OrderStageDecorator.hpp"
#include "units/Measurements.hpp"
#include "units/SetPoints.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief A stage that limits the acceleration and the speed of the robot.
///
/// @function Changes set-points of velocity and voltage step by step towards the ordered values. A
/// velocity changes by at most 0.5 m/s^2. In a cycle, a voltage changes by at most 1.0 V away from
/// 0, and by at most 2.4 V towards 0. At a greater steering angle the greatest permitted velocity
/// is lower. When an order exceeds this velocity, one factor lowers the velocities of all wheels.
/// Therefore the ratio of these velocities stays as ordered. While a wheel is too fast, another
/// factor lowers the set-points of all wheels.
///
/// @secret The greatest change of a set-point in a cycle, the greatest velocity in a curve, and the
/// rule by which the robot slows down when it is too fast.
class SetPointRamp final : public OrderStageDecorator {
 public:
  /// @param wrapped stage that receives the limited set-points
  explicit SetPointRamp(OrderStage& wrapped);

  /// @brief Limits the set-points, and forwards them.
  /// @param setPoints set-points of the cycle
  /// @param cycle number of the cycle
  /// @satisfies FR-282
  /// @satisfies FR-294
  /// @satisfies FR-295
  /// @isr{no}
  void follow(const SetPoints& setPoints, std::uint32_t cycle) override;

  /// @brief Halts the wheels and holds the steering. The next ramp of a velocity begins at 0.
  /// @param cycle number of the cycle
  /// @satisfies FR-282
  /// @isr{no}
  void stand(std::uint32_t cycle) override;

  /// @brief Forwards the acknowledgement. The next ramp of a velocity begins at 0.
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
  std::array<std::int32_t, kWheelCount> ramped_{};  // [0.1 rpm] set-point of each wheel
  // For each wheel: true if the previous set-point was a voltage or a current.
  std::array<bool, kWheelCount> other_{};
  // [0.1 rpm] Magnitude of the velocity of each wheel in the previous cycle.
  std::array<std::int32_t, kWheelCount> velocities_{};
  // [0.001] Factor of all set-points. This factor falls while a wheel is too fast.
  std::int32_t share_ = 1000;
};

}  // namespace wr
