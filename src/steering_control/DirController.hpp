#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "devices/Timebase.hpp"
#include "services/Pipe.hpp"
#include "steering_control/algorithms/SteeringAlgorithm.hpp"
#include "steering_control/commands/SteeringCommand.hpp"
#include "steering_control/states/DirState.hpp"
#include "units/Measurements.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief An order to the steering.
/// @datatype
struct DirTarget {
  Angle angle{};         ///< target angle [0.01 degree], -3200 to 3200; used only if `follow`
  bool follow = false;   ///< true to turn to the target angle, false to hold the steering
  bool release = false;  ///< true to leave the fault state

  /// @brief Returns whether two targets are equal.
  friend constexpr bool operator==(const DirTarget&, const DirTarget&) = default;
};

/// @brief The state and the measurements of the steering in one tick.
/// @datatype
struct DirStatus {
  SteeringState state = SteeringState::Off;  ///< state of the controller
  StepRate rate{};                           ///< speed of the motor [steps/s], positive to the left
  bool leftEnd = false;                      ///< the left end stop is reached
  bool rightEnd = false;                     ///< the right end stop is reached
  std::optional<Stamped<Angle>> position{};  ///< newest position, and the time of its measurement
};

/// @brief State of the motor at the beginning of a tick.
/// @datatype
struct TurnFeedback {
  StepRate rate{};         ///< speed of the motor [steps/s], positive to the left
  std::int32_t steps = 0;  ///< steps to the left minus steps to the right, since start
  bool ready = false;      ///< the motor is on and has settled
  bool leftEnd = false;    ///< the left end stop is reached
  bool rightEnd = false;   ///< the right end stop is reached
};

/// @brief The controller of the steering: computes the turn from target and position.
///
/// @function At the end of each measurement of the position, calls tick() of the present state. The
/// state uses the newest target, the newest position and the state of the motor. Then the
/// controller writes the status of the steering to a pipe. The controller controls the motor
/// through commands, and names neither the sensor nor the device.
///
/// @secret The greatest permitted age of a target and of a position, and the rule that detects a
/// contradiction between the measured angle and the steps of the motor.
///
/// @role{steering-controller-states, Context}
/// @role{steering-control-algorithm, Context}
/// @role{steering-commands, Invoker}
/// @role{steering-timer-interrupt, Receiver}
class DirController final {
 public:
  /// @brief Parts of the controller. Each part must exist for as long as the controller exists.
  /// @datatype
  struct Parts {
    Pipe<DirTarget>& target;       ///< the newest order; the main thread writes it
    Pipe<Angle>& position;         ///< the position; the sensor of the steering writes it
    Pipe<DirStatus>& status;       ///< the status of the steering; the main thread reads it
    const Timebase& timebase;      ///< returns the time, to compute the age of a value
    SteeringAlgorithm& algorithm;  ///< computes the turn
    SteeringCommand& enable;       ///< switches the motor on
    SteeringCommand& disable;      ///< switches the motor off
    SteeringCommand& setTurn;      ///< sets the speed of the motor
    DirState& initial;             ///< state at start: off
  };

  /// @param parts parts of the controller
  explicit DirController(const Parts& parts);

  DirController(const DirController&) = delete;
  DirController& operator=(const DirController&) = delete;

  /// @brief Reads target and position, calls tick() of the present state, and writes the
  /// status. The caller calls this function when a measurement of the position ends.
  /// @param motor state of the motor
  /// @isr{yes}
  /// @satisfies FR-114
  /// @satisfies FR-116
  void tick(const TurnFeedback& motor);

  /// @brief Returns whether an order to follow a set-point is in force. The states call this
  /// method.
  /// @return true if the newest target contains the order to follow an angle, and is not older than
  /// 300 ms
  /// @isr{yes}
  /// @satisfies FR-106
  [[nodiscard]] bool following() const;

  /// @brief Returns whether orders no longer arrive. The states call this method.
  /// @return true if there is no target, or if the newest target is older than 300 ms
  /// @isr{yes}
  /// @satisfies FR-109
  [[nodiscard]] bool abandoned() const;

  /// @brief Checks whether the release of a fault was ordered after the last change of state. The
  /// states call this method.
  /// @return true if the newest target contains the order to release a fault, and was written after
  /// the present state began
  /// @isr{yes}
  /// @satisfies FR-112
  [[nodiscard]] bool released() const;

  /// @brief Returns whether the position of the steering is unknown. The states call this method.
  /// @return true if there is no position, or if the newest position is older than 20 ms
  /// @isr{yes}
  /// @satisfies FR-110
  [[nodiscard]] bool lost() const;

  /// @brief Checks whether the inputs of the steering contradict each other. They contradict each
  /// other if both end stops are reached. They also contradict each other if the measured position
  /// differs by more than 3 degrees from the computed position. The computed position results from
  /// the steps of the motor since the motor was switched on. In each second, the method subtracts
  /// up to 0.05 degrees from the difference, because a push can move the motor by some steps. The
  /// states call this method.
  /// @return true if the inputs contradict each other
  /// @pre The position is not lost.
  /// @isr{yes}
  /// @satisfies FR-226
  /// @satisfies FR-227
  [[nodiscard]] bool inconsistent();

  /// @brief Starts to monitor whether the steering follows the steps of the motor. The states call
  /// this method.
  /// @pre The position is not lost.
  /// @isr{yes}
  /// @satisfies FR-111
  void watch();

  /// @brief Checks whether the steering fails to follow the steps of the motor. A window of the
  /// check ends when at least 200 ms have passed and the steps amount to at least 0.6 degrees. Then
  /// the next window starts. The states call this method.
  /// @return true if a window has ended, and in this window the steering has moved less than half
  /// of the angle that the steps require
  /// @pre watch() was called, and the position is not lost.
  /// @isr{yes}
  /// @satisfies FR-111
  [[nodiscard]] bool stalled();

  /// @brief Returns the speed at which the motor turns the steering towards its target. The states
  /// call this method.
  /// @return speed that the algorithm computes [steps/s], -500 to 500; 0 if no order to follow a
  /// set-point is in force, if the motor is not ready, or if it would turn towards a reached end
  /// stop
  /// @pre The position is not lost.
  /// @isr{yes}
  /// @satisfies FR-101
  /// @satisfies FR-105
  /// @satisfies FR-107
  /// @satisfies FR-108
  [[nodiscard]] StepRate demand();

  /// @brief Returns whether the motor makes no steps. The states call this method.
  /// @return true if the speed of the motor is 0
  /// @isr{yes}
  /// @satisfies FR-101
  [[nodiscard]] bool atRest() const;

  /// @brief Switches the motor on. The states call this method.
  /// @isr{yes}
  /// @satisfies FR-106
  void enable();

  /// @brief Switches the motor off. The states call this method.
  /// @isr{yes}
  /// @satisfies FR-109
  /// @satisfies FR-110
  /// @satisfies FR-111
  void disable();

  /// @brief Sets the target speed of the motor. The states call this method.
  /// @param rate speed of the motor [steps/s], -500 to 500, positive to the left
  /// @isr{yes}
  /// @satisfies FR-101
  void turn(StepRate rate);

  /// @brief Sets the state. The states call this method.
  /// @param next state that applies from the next tick
  /// @isr{yes}
  void changeState(DirState& next);

 private:
  /// @brief Writes the status of the steering and the time of this tick to the pipe.
  /// @satisfies FR-116
  void publish();

  [[nodiscard]] bool astray();

  Pipe<DirTarget>& targets_;
  Pipe<Angle>& positions_;
  Pipe<DirStatus>& status_;
  const Timebase& timebase_;
  SteeringAlgorithm& algorithm_;
  SteeringCommand& enable_;
  SteeringCommand& disable_;
  SteeringCommand& setTurn_;
  std::reference_wrapper<DirState> state_;
  Instant changedAt_{};  // time at which the present state began
  // values of this tick
  Instant now_{};
  TurnFeedback motor_{};
  std::optional<Stamped<DirTarget>> target_{};
  std::optional<Stamped<Angle>> position_{};
  // time, steps and position at the start of the window
  Instant watchedSince_{};
  std::int32_t watchedSteps_ = 0;
  Angle watchedPosition_{};
  // difference between position and steps when the motor was switched on, adapted in each
  // kForgetPeriod
  std::optional<Angle> offset_;
  Instant forgottenAt_{};
};

}  // namespace wr
