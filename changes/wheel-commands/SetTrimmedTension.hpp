#pragma once

#include "wheel_control/Wheel.hpp"
#include "wheel_control/commands/WheelCommand.hpp"

namespace wr {

/// @brief A command that sets the voltage of a wheel. The driver of the wheel loses voltage: the
/// loss is a twelfth of the motor voltage. Therefore the command adds a twelfth to the ordered
/// voltage.
class SetTrimmedTension final : public WheelCommand {
 public:
  /// @param wheel wheel whose voltage is set
  explicit SetTrimmedTension(Wheel& wheel) : wheel_(wheel) {}

  /// @brief Sets 13/12 of the magnitude of the voltage, at most 24 V.
  /// @param tension voltage that the motor shall have [mV], -24000 to 24000
  /// @isr{no}
  void execute(Tension tension) override {
    const Tension size = tension < Tension() ? -tension : tension;
    const Tension more = size + size / kShare;
    wheel_.setTension(more > kMost ? kMost : more);
  }

 private:
  static constexpr std::int32_t kShare = 12;
  static constexpr Tension kMost{24000};

  Wheel& wheel_;
};

}  // namespace wr
