#pragma once

#include <atomic>
#include <cstdint>

#include "devices/DigitalOutput.hpp"
#include "devices/PwmOutput.hpp"
#include "services/Command.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief One wheel: its motor behind a driver.
///
/// @function Sets voltage and orientation of the motor, stops it, and switches its driver off when the
/// current is too high: the overcurrent trip. An enabled driver applies the supply voltage times
/// the duty cycle to the motor, in the present orientation. The motor can drive and brake in this
/// orientation. Without
/// duty cycle the motor is short-circuited and brakes. A disabled driver leaves the motor open, and
/// the wheel coasts.
///
/// @secret How the driver of a motor applies a voltage, how a tripped driver brakes, and how an
/// interrupt and a thread share its state.
///
/// @role{wheel-commands, Receiver}
class Wheel final {
 public:
  /// @brief Binds the wheel to its driver. The outputs are at their safe level: the driver is off, the
  /// orientation is forwards.
  /// @param pwm sets the duty cycle
  /// @param orientation on means backwards
  /// @param enable on means that the driver is enabled
  Wheel(PwmOutput& pwm, DigitalOutput& orientation, DigitalOutput& enable);

  Wheel(const Wheel&) = delete;
  Wheel& operator=(const Wheel&) = delete;

  /// @brief Removes all voltage from the motor: it is short-circuited and brakes. During an
  /// overcurrent trip the caller calls this function once in each control cycle. The second call,
  /// when the current has decayed, enables the driver for braking.
  /// @post The driver is enabled, unless its overcurrent trip acted less than a cycle ago or acted twice.
  /// @satisfies FR-88
  /// @satisfies FR-89
  /// @satisfies FR-221
  /// @isr{no}
  void stop();

  /// @brief Sets the voltage, in the present orientation. The duty cycle is rounded to the nearest
  /// 0.01 %.
  /// @param magnitude voltage [mV], 0 to 24000; a greater value counts as the limit
  /// @post The driver is enabled; after an overcurrent trip the voltage and the driver do not
  /// change.
  /// @satisfies FR-80
  /// @satisfies FR-86
  /// @isr{no}
  void setTension(Tension magnitude);

  /// @brief Sets the orientation.
  /// @param backwards true to turn backwards
  /// @satisfies FR-87
  /// @isr{no}
  void setOrientation(bool backwards);

  /// @brief Returns the command of the overcurrent trip, for an interrupt to execute. It switches the
  /// driver off at once.
  /// @return command of this wheel; after its execution the motor has no voltage until release()
  /// @satisfies FR-89
  /// @isr{yes}
  [[nodiscard]] Command& cutOff();

  /// @brief Checks whether the overcurrent trip has acted.
  /// @return true from the execution of cutOff() to release()
  /// @satisfies FR-89
  /// @isr{yes}
  [[nodiscard]] bool isCutOff() const;

  /// @brief Resets the overcurrent trip. The next setTension() or stop() enables the driver.
  /// @satisfies FR-89
  /// @isr{no}
  void release();

 private:
  /// State of the overcurrent trip.
  enum class Trip : std::uint8_t {
    None,      ///< nothing
    Tripped,   ///< the driver is off
    Decaying,  ///< the driver is off, and the thread has detected this
    Braking,   ///< the driver is on, without voltage
    Off        ///< the trip acted again while braking: the driver stays off
  };

  /// Switches the driver off.
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

  static_assert(std::atomic<Trip>::is_always_lock_free, "an interrupt cannot wait for a lock");
};

}  // namespace wr
