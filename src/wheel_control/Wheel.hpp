#pragma once

#include <atomic>

#include "devices/DigitalOutput.hpp"
#include "devices/PwmOutput.hpp"
#include "services/Command.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief One wheel: its motor behind a driver.
///
/// @function Sets tension and orientation of the motor, stops it, and switches its driver off when the
/// current is too high. An enabled driver puts the duty cycle's share of the supply on the motor,
/// in the present orientation: the motor can drive and brake in it. Without duty cycle the motor is
/// short-circuited and brakes. A disabled driver leaves the motor open, and the wheel coasts.
///
/// @secret How the driver of a motor is made to apply a tension, and how a driver that an interrupt has
/// switched off is kept from being switched on again.
///
/// @role{wheel-commands, Receiver}
class Wheel final {
 public:
  /// @brief Binds the wheel to its driver. The outputs are at their safe level: the driver is off, the
  /// orientation is forwards.
  /// @param pwm sets the share of the supply
  /// @param orientation on means backwards
  /// @param enable on means that the driver drives
  Wheel(PwmOutput& pwm, DigitalOutput& orientation, DigitalOutput& enable);

  Wheel(const Wheel&) = delete;
  Wheel& operator=(const Wheel&) = delete;

  /// @brief Takes all tension from the motor: it is short-circuited and brakes.
  /// @post The driver is enabled, unless it is cut off.
  /// @satisfies FR-88
  /// @isr{no}
  void stop();

  /// @brief Sets the tension, in the present orientation. The duty cycle is rounded to the nearest
  /// 0.01 %.
  /// @param magnitude tension [mV], 0 to 24000; what is beyond counts as the limit
  /// @post The driver is enabled, unless it is cut off.
  /// @satisfies FR-80
  /// @satisfies FR-86
  /// @isr{no}
  void setTension(Tension magnitude);

  /// @brief Sets the orientation.
  /// @param backwards true to turn backwards
  /// @satisfies FR-87
  /// @isr{no}
  void setOrientation(bool backwards);

  /// @brief Gives the command that switches the driver off at once, for an interrupt to execute.
  /// @return command of this wheel; after it nothing but release() lets the driver be switched on
  /// @satisfies FR-89
  /// @isr{yes}
  [[nodiscard]] Command& cutOff();

  /// @brief Tells whether the driver is cut off.
  /// @return true from the execution of cutOff() to release()
  /// @satisfies FR-89
  /// @isr{yes}
  [[nodiscard]] bool isCutOff() const;

  /// @brief Ends the cut-off. The driver is switched on by the next setTension() or stop().
  /// @satisfies FR-89
  /// @isr{no}
  void release();

 private:
  /// Switches the driver off, and keeps it off.
  class CutOff final : public Command {
   public:
    explicit CutOff(Wheel& wheel);
    void execute() override;

   private:
    Wheel& wheel_;
  };

  void enableDriver();

  CutOff command_;
  PwmOutput& pwm_;
  DigitalOutput& orientation_;
  DigitalOutput& enable_;
  std::atomic<bool> isCutOff_{false};  // an interrupt sets it, the thread of the wheel clears it

  static_assert(std::atomic<bool>::is_always_lock_free, "an interrupt cannot wait");
};

}  // namespace wr
