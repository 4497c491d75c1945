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
/// @function Switches the motor on and off, and turns it step by step with the demanded rate,
/// within the limits of the motor. Never turns it further towards an end stop that is reached.
///
/// @secret The pulses for a step of the motor, the limits of the motor, and the levels of its end
/// stops.
///
/// @role{steering-switch, Context}
/// @role{steering-commands, Receiver}
class SteeringDevice final {
 public:
  /// @brief Parts of the device. Each part exists as long as the device.
  /// @datatype
  struct Parts {
    DigitalOutput& step;        ///< the motor makes a step each time this output is switched on
    DigitalOutput& direction;   ///< on for steps to the left
    DigitalOutput& enable;      ///< on when the motor has current
    const EdgeInput& leftEnd;   ///< high when the left end stop is reached, or its wire is broken
    const EdgeInput& rightEnd;  ///< high when the right end stop is reached, or its wire is broken
    SteeringPower& initial;     ///< power at start: off
  };

  /// @brief Binds the device to its parts.
  /// @param parts parts of the device
  explicit SteeringDevice(const Parts& parts);

  SteeringDevice(const SteeringDevice&) = delete;
  SteeringDevice& operator=(const SteeringDevice&) = delete;

  /// @brief Switches the motor on, unless it is on. The motor makes steps only after it has
  /// settled.
  /// @isr{yes}
  /// @satisfies FR-106
  void enable();

  /// @brief Switches the motor off, unless it is off. The motor stops at once.
  /// @isr{yes}
  /// @satisfies FR-109
  /// @satisfies FR-113
  void disable();

  /// @brief Returns whether the motor can step.
  /// @return true when it is on and has settled
  /// @isr{yes}
  /// @satisfies FR-107
  [[nodiscard]] bool ready() const;

  /// @brief Sets the target rate of the motor. A motor that is switched on later begins with a rate
  /// of 0.
  /// @param demand rate [steps/s], positive to the left; a greater rate counts as the limit
  /// @isr{yes}
  /// @satisfies FR-103
  void turn(StepRate demand);

  /// @brief Ends the pulse of the previous tick, and runs one tick of the motor. It is called
  /// once in each tick period.
  /// @isr{yes}
  /// @satisfies FR-103
  /// @satisfies FR-104
  void tick();

  /// @brief Returns the present rate of the motor.
  /// @return rate [steps/s], -500 to 500, positive to the left
  /// @isr{yes}
  /// @satisfies FR-103
  [[nodiscard]] StepRate rate() const;

  /// @brief Checks whether the left end stop is reached. Its contact is then open.
  /// @return true when it is reached, or when its wire is broken
  /// @isr{yes}
  /// @satisfies FR-105
  /// @satisfies FR-225
  [[nodiscard]] bool leftEnd() const;

  /// @brief Checks whether the right end stop is reached. Its contact is then open.
  /// @return true when it is reached, or when its wire is broken
  /// @isr{yes}
  /// @satisfies FR-105
  /// @satisfies FR-225
  [[nodiscard]] bool rightEnd() const;

  /// @brief Returns the number of steps of the motor.
  /// @return steps to the left minus steps to the right, since start
  /// @isr{yes}
  /// @satisfies FR-111
  [[nodiscard]] std::int32_t steps() const;

  /// @brief Sets the power state. Power states call it.
  /// @param power state from now on
  /// @isr{yes}
  void changePower(SteeringPower& power);

  /// @brief Switches the current of the motor on, and starts the time in which it settles. Power states call it.
  /// @isr{yes}
  /// @satisfies FR-106
  /// @satisfies FR-107
  void switchOn();

  /// @brief Switches the current of the motor off, and sets its rate to 0. Power states call it.
  /// @isr{yes}
  /// @satisfies FR-113
  void switchOff();

  /// @brief Returns whether the time in which the motor settles has passed. Power states call it.
  /// @return true when it has passed
  /// @isr{yes}
  /// @satisfies FR-107
  [[nodiscard]] bool settled() const;

  /// @brief Executes one tick of the motor: lets it settle, or changes its rate towards the demand
  /// and makes a step when it is due. Power states call it.
  /// @isr{yes}
  /// @satisfies FR-103
  /// @satisfies FR-105
  /// @satisfies FR-107
  void advance();

 private:
  /// @brief Changes the rate towards the demand; towards an end stop that is reached the rate is 0.
  /// Sets the direction when a turn begins.
  /// @satisfies FR-103
  /// @satisfies FR-104
  /// @satisfies FR-105
  void changeRate();

  /// @brief Adds the rate to the remaining part of a step, and makes a step when it is due.
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
  std::int32_t steps_ = 0;     // steps to the left since start
  std::int32_t settling_ = 0;  // ticks until the motor has settled
  bool pulse_ = false;         // the step output is on
};

}  // namespace wr
