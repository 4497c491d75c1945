#pragma once

#include <array>
#include <cstdint>

#include "safety/ContactWatch.hpp"
#include "safety/OrderStageDecorator.hpp"
#include "safety/RetainedProtection.hpp"
#include "safety/WheelComparison.hpp"
#include "safety/WheelSupervision.hpp"
#include "units/Measurements.hpp"

namespace wr {

/// @brief Stops the whole robot when one of its parts fails.
///
/// @function Checks the contact of the emergency-stop circuit, the steering and every wheel after each
/// order. When a part fails, all control systems hold in this cycle and in every later cycle until
/// an acknowledgement.
///
/// @secret Which parts are supervised, and how long a protective stop lasts.
class ProtectiveStop final : public OrderStageDecorator {
 public:
  /// @brief Binds the protective stop to the robot.
  /// @param wrapped all control systems of the robot
  /// @param emergencyStop watches the contact of the emergency-stop circuit
  /// @param memory stores the protective stop; a protective stop from before a reset is latched
  /// again
  ProtectiveStop(OrderStage& wrapped, ContactWatch& emergencyStop, RetainedProtection& memory);

  /// @brief Adds the measurements and outputs of the robot, and the state of the protective stop.
  /// @param measurements receives the measurements
  /// @param outputs receives the outputs
  /// @satisfies FR-281
  /// @isr{no}
  void collect(Measurements& measurements, Outputs& outputs) const override;

  /// @brief Forwards set-points; holds the robot while a protective stop is latched.
  /// @param setPoints set-points of the cycle
  /// @param cycle number of the cycle
  /// @satisfies FR-270
  /// @isr{no}
  void follow(const SetPoints& setPoints, std::uint32_t cycle) override;

  /// @brief Holds the robot and checks it.
  /// @param cycle number of the cycle
  /// @satisfies FR-270
  /// @isr{no}
  void stand(std::uint32_t cycle) override;

  /// @brief Releases the protective stop.
  /// @param cycle number of the cycle
  /// @satisfies FR-291
  /// @isr{no}
  void recover(std::uint32_t cycle) override;

 private:
  /// @brief Checks all parts, and latches the first cause.
  /// @param followed set-points that the robot follows; nullptr while it is held
  /// @satisfies FR-271
  /// @satisfies FR-272
  /// @satisfies FR-273
  void examine(const SetPoints* followed);
  /// @brief Compares the wheels with each other while they follow set-points.
  /// @param measurements measurements of the cycle
  /// @param following true while they follow set-points
  /// @satisfies FR-297
  /// @satisfies FR-298
  void compareWheels(const Measurements& measurements, bool following);
  void latch(StopCause cause, std::uint8_t wheel);
  [[nodiscard]] bool latched() const;

  ContactWatch& emergencyStop_;
  RetainedProtection& memory_;
  std::array<WheelSupervision, kWheelCount> wheels_;
  WheelComparison comparison_;
  Measurements measurements_;  // measurements of the present cycle
  Outputs outputs_;
  StopCause cause_;
  std::uint8_t wheel_;
};

}  // namespace wr
