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

/// @brief A stage that stops the robot after a fault of a component, or when the emergency stop is
/// pressed.
///
/// @function Checks the contact of the emergency-stop circuit, the steering and every wheel in each
/// cycle, until a check finds a fault. Then latches a protective stop: the wheels halt and the
/// steering keeps its angle, from this cycle until an acknowledgement.
///
/// @secret The devices that are checked, and the duration of a protective stop.
class ProtectiveStop final : public OrderStageDecorator {
 public:
  /// @brief Reads the memory. If a protective stop was latched before a reset, latches this stop
  /// again.
  /// @param wrapped stage that forwards orders to all control systems of the robot
  /// @param emergencyStop watches the contact of the emergency-stop circuit
  /// @param memory memory of the protective stop; a reset does not clear this memory
  ProtectiveStop(OrderStage& wrapped, ContactWatch& emergencyStop, RetainedProtection& memory);

  /// @brief Writes the measurements and outputs of the robot, and the state of the protective stop.
  /// @param measurements receives the measurements
  /// @param outputs receives the outputs
  /// @satisfies FR-281
  /// @isr{no}
  void collect(Measurements& measurements, Outputs& outputs) const override;

  /// @brief Forwards set-points, and checks the robot. While a protective stop is latched, does not
  /// forward the set-points, but halts the wheels and holds the steering.
  /// @param setPoints set-points of the cycle
  /// @param cycle number of the cycle
  /// @satisfies FR-270
  /// @satisfies FR-271
  /// @isr{no}
  void follow(const SetPoints& setPoints, std::uint32_t cycle) override;

  /// @brief Halts the wheels and holds the steering, then checks the robot.
  /// @param cycle number of the cycle
  /// @satisfies FR-270
  /// @satisfies FR-271
  /// @isr{no}
  void stand(std::uint32_t cycle) override;

  /// @brief Releases the protective stop, and forwards the acknowledgement. If the contact of the
  /// emergency-stop circuit is open, or has opened after the last cycle, latches a protective stop.
  /// @param cycle number of the cycle
  /// @satisfies FR-291
  /// @isr{no}
  void recover(std::uint32_t cycle) override;

 private:
  /// @brief Checks the emergency-stop contact, the steering and the wheels, and latches the first
  /// cause of a protective stop.
  /// @param followed set-points that the robot follows; nullptr while it follows no set-points
  /// @satisfies FR-271
  /// @satisfies FR-272
  /// @satisfies FR-273
  void examine(const SetPoints* followed);
  /// @brief Latches a protective stop if the contact of the emergency-stop circuit is open, or if
  /// an opening was recorded since the last cycle.
  /// @satisfies FR-271
  /// @satisfies FR-291
  void examineContact();
  /// @brief Compares the wheels with each other while they follow set-points.
  /// @param measurements measurements of the cycle
  /// @param following true while the wheels follow set-points; if it is false, the records of the
  /// comparison are cleared
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
