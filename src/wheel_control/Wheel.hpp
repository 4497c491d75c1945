#pragma once

#include <atomic>
#include <cstdint>

#include "devices/DigitalOutput.hpp"
#include "devices/PwmOutput.hpp"
#include "services/Command.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief A wheel: a motor and its driver.
///
/// @function Sets the voltage and the orientation of the motor, and stops the motor. Switches the
/// driver off when the current is too high: this is the overcurrent trip. An enabled driver applies
/// a voltage to the motor, in the present orientation: the supply voltage multiplied by the duty
/// cycle. The motor can drive and brake in this orientation. When the duty cycle is 0, the motor is
/// short-circuited and brakes. When the driver is disabled, the motor is disconnected and the wheel
/// coasts.
///
/// @secret The method by which the driver of a motor applies a voltage, the method by which a
/// tripped driver brakes, and the rule by which an interrupt and a thread share the state of the
/// trip.
///
/// @role{wheel-commands, Receiver}
class Wheel final {
 public:
  /// @param pwm sets the duty cycle
  /// @param orientation output that is on when the motor shall turn backwards
  /// @param enable output that is on to enable the driver
  /// @pre The outputs are at their safe levels: the driver is off, and the orientation is forwards.
  Wheel(PwmOutput& pwm, DigitalOutput& orientation, DigitalOutput& enable);

  Wheel(const Wheel&) = delete;
  Wheel& operator=(const Wheel&) = delete;

  /// @brief Removes all voltage from the motor, which is then short-circuited and brakes. After an
  /// overcurrent trip the caller calls this function once in each control cycle. Before the second
  /// call the current has decayed. Therefore the second call enables the driver, and the motor
  /// brakes.
  /// @post The driver is enabled, except in two cases: this is the first call after an overcurrent
  /// trip, or the trip acted again while the motor braked.
  /// @satisfies FR-88
  /// @satisfies FR-89
  /// @satisfies FR-221
  /// @isr{no}
  void stop();

  /// @brief Sets the voltage in the present orientation. The duty cycle is rounded to the nearest
  /// 0.01 %.
  /// @param magnitude voltage [mV], 0 to 24000; a greater value counts as 24000
  /// @post The driver is enabled. After an overcurrent trip, however, this function changes neither
  /// the voltage nor the driver.
  /// @satisfies FR-80
  /// @satisfies FR-86
  /// @isr{no}
  void setTension(Tension magnitude);

  /// @brief Sets the orientation.
  /// @param backwards true to turn backwards
  /// @satisfies FR-87
  /// @isr{no}
  void setOrientation(bool backwards);

  /// @brief Returns the command of the overcurrent trip. An interrupt executes this command, which
  /// switches the driver off at once.
  /// @return command of this wheel; after its execution the motor has no voltage until release()
  /// @satisfies FR-89
  /// @isr{yes}
  [[nodiscard]] Command& cutOff();

  /// @brief Checks whether the overcurrent trip has acted.
  /// @return true from the execution of cutOff() until release() resets the trip
  /// @satisfies FR-89
  /// @isr{yes}
  [[nodiscard]] bool isCutOff() const;

  /// @brief Resets the overcurrent trip. The next setTension() or stop() enables the driver. Before
  /// the first stop() after a trip, this function does nothing: the current has not decayed, and no
  /// report shows the trip yet.
  /// @satisfies FR-89
  /// @isr{no}
  void release();

 private:
  /// State of the overcurrent trip.
  enum class Trip : std::uint8_t {
    None,      ///< the trip has not acted
    Tripped,   ///< the trip has acted: the driver is off
    Decaying,  ///< the driver is off, and stop() was called once after the trip
    Braking,   ///< the driver is on with the duty cycle 0: the motor brakes
    Off        ///< the trip acted again while the motor braked: the driver stays off
  };

  /// Command that switches the driver off.
  class CutOff final : public Command {
   public:
    explicit CutOff(Wheel& wheel);
    void execute() override;

   private:
    Wheel& wheel_;
  };

  void enableDriver(Trip permitted);

  CutOff command_;
  PwmOutput& pwm_;
  DigitalOutput& orientation_;
  DigitalOutput& enable_;
  std::atomic<Trip> trip_{Trip::None};  // shared by an interrupt and the thread of the wheel

  static_assert(std::atomic<Trip>::is_always_lock_free, "an interrupt must not wait for a lock");
};

}  // namespace wr
