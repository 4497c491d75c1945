#pragma once

#include <cstdint>
#include <functional>

#include "devices/DigitalOutput.hpp"
#include "devices/EdgeInput.hpp"
#include "steering_control/power/SteeringPower.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief The motor of the steering, with its driver and its end stops.
///
/// @function Switches the motor on and off. Turns the motor step by step at the demanded rate,
/// within the limits of the motor. Makes no step towards an end stop that is reached.
///
/// @secret The pulses for a step of the motor, the limits of the motor, and the levels of its end
/// stops.
///
/// @role{steering-switch, Context}
/// @role{steering-commands, Receiver}
class SteeringDevice final {
 public:
  /// @brief Parts of the device. Each part must exist for as long as the device exists.
  /// @datatype
  struct Parts {
    DigitalOutput& step;        ///< the motor makes a step each time this output is switched on
    DigitalOutput& direction;   ///< on for steps to the left
    DigitalOutput& enable;      ///< on when the motor has current
    const EdgeInput& leftEnd;   ///< high if the left end stop is reached or its wire is broken
    const EdgeInput& rightEnd;  ///< high if the right end stop is reached or its wire is broken
    SteeringPower& initial;     ///< power state at start: off
  };

  /// @param parts parts of the device
  explicit SteeringDevice(const Parts& parts);

  SteeringDevice(const SteeringDevice&) = delete;
  SteeringDevice& operator=(const SteeringDevice&) = delete;

  /// @brief Switches the motor on if it is off. The motor makes steps only after it has settled.
  /// @isr{yes}
  /// @satisfies FR-106
  void enable();

  /// @brief Switches the motor off if it is on. The motor stops at once.
  /// @isr{yes}
  /// @satisfies FR-109
  /// @satisfies FR-113
  void disable();

  /// @brief Returns whether the motor can make steps.
  /// @return true if the motor is on and has settled
  /// @isr{yes}
  /// @satisfies FR-107
  [[nodiscard]] bool ready() const;

  /// @brief Sets the target rate of the motor. When the motor is switched on, its target rate is
  /// reset to 0.
  /// @param demand rate [steps/s], positive to the left; a rate beyond the limit of the motor is
  /// reduced to this limit
  /// @isr{yes}
  /// @satisfies FR-103
  void turn(StepRate demand);

  /// @brief Ends the pulse of the previous tick, and executes one tick of the motor. The caller
  /// calls this function once in each tick.
  /// @isr{yes}
  /// @satisfies FR-103
  /// @satisfies FR-104
  void tick();

  /// @brief Returns the present rate of the motor.
  /// @return rate [steps/s], -500 to 500, positive to the left
  /// @isr{yes}
  /// @satisfies FR-103
  [[nodiscard]] StepRate rate() const;

  /// @brief Checks whether the left end stop is reached. The contact of a reached end stop is open.
  /// @return true if the end stop is reached or its wire is broken
  /// @isr{yes}
  /// @satisfies FR-105
  /// @satisfies FR-225
  [[nodiscard]] bool leftEnd() const;

  /// @brief Checks whether the right end stop is reached. The contact of a reached end stop is
  /// open.
  /// @return true if the end stop is reached or its wire is broken
  /// @isr{yes}
  /// @satisfies FR-105
  /// @satisfies FR-225
  [[nodiscard]] bool rightEnd() const;

  /// @brief Returns the number of steps of the motor.
  /// @return steps to the left minus steps to the right, since start
  /// @isr{yes}
  /// @satisfies FR-111
  [[nodiscard]] std::int32_t steps() const;

  /// @brief Sets the power state. The power states call this method.
  /// @param power state from now on
  /// @isr{yes}
  void changePower(SteeringPower& power);

  /// @brief Switches the current of the motor on, and starts the settling time of the motor. The
  /// power states call this method.
  /// @isr{yes}
  /// @satisfies FR-106
  /// @satisfies FR-107
  void switchOn();

  /// @brief Switches the current of the motor off, and sets the rate of the motor to 0. The power
  /// states call this method.
  /// @isr{yes}
  /// @satisfies FR-113
  void switchOff();

  /// @brief Returns whether the motor has settled. The power states call this method.
  /// @return true if the settling time of the motor has passed
  /// @isr{yes}
  /// @satisfies FR-107
  [[nodiscard]] bool settled() const;

  /// @brief Executes one tick of the motor. While the motor settles, only counts the tick.
  /// Afterwards changes the rate towards the demand, and makes a step when the step is due. The
  /// power states call this method.
  /// @isr{yes}
  /// @satisfies FR-103
  /// @satisfies FR-105
  /// @satisfies FR-107
  void advance();

 private:
  /// @brief Changes the rate towards the demand, within the acceleration limit. If the motor turns
  /// towards an end stop that is reached, the rate becomes 0. Sets the direction when a turn
  /// begins.
  /// @satisfies FR-103
  /// @satisfies FR-104
  /// @satisfies FR-105
  void changeRate();

  /// @brief Adds the rate to the completed part of the next step. When this part is a whole step,
  /// makes the step.
  /// @satisfies FR-104
  void stepWhenDue();

  DigitalOutput& step_;
  DigitalOutput& direction_;
  DigitalOutput& enable_;
  const EdgeInput& leftEnd_;
  const EdgeInput& rightEnd_;
  std::reference_wrapper<SteeringPower> power_;
  std::int32_t demand_ = 0;    // steps/s
  std::int32_t rate_ = 0;      // steps/s
  std::int32_t part_ = 0;      // completed part of the next step, in thousandths
  std::int32_t steps_ = 0;     // steps to the left minus steps to the right, since start
  std::int32_t settling_ = 0;  // ticks until the motor has settled
  bool pulse_ = false;         // the step output is on
};

}  // namespace wr
