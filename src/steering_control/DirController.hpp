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
  Angle angle{};         ///< target angle [0.01 degree], -3200 to 3200; not used for a hold
  bool follow = false;   ///< true to turn to this angle, false to hold
  bool release = false;  ///< true to leave the fault state

  /// @brief Returns whether two targets are equal.
  friend constexpr bool operator==(const DirTarget&, const DirTarget&) = default;
};

/// @brief The measurements of the steering at a tick.
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

/// @brief Controls the steering: computes the turn from target and position.
///
/// @function At the end of each measurement of the position, lets the state of the steering act on
/// the newest target, the newest position and the state of the motor. Then publishes the result. It
/// controls the motor through commands, and does not name the sensor or the device.
///
/// @secret The greatest age of a target and a position, and how a contradiction between angle and
/// motor is detected.
///
/// @role{steering-controller-states, Context}
/// @role{steering-control-algorithm, Context}
/// @role{steering-commands, Invoker}
/// @role{steering-timer-interrupt, Receiver}
class DirController final {
 public:
  /// @brief Parts of the controller. Each part exists as long as the controller.
  /// @datatype
  struct Parts {
    Pipe<DirTarget>& target;       ///< the newest order; the main thread writes it
    Pipe<Angle>& position;         ///< the position of the steering; the same interrupt writes it
    Pipe<DirStatus>& status;       ///< state of the steering; the main thread reads it
    const Timebase& timebase;      ///< returns the time, for the age of a value
    SteeringAlgorithm& algorithm;  ///< computes the turn
    SteeringCommand& enable;       ///< switches the motor on
    SteeringCommand& disable;      ///< switches the motor off
    SteeringCommand& setTurn;      ///< sets the speed of the motor
    DirState& initial;             ///< state at start: off
  };

  /// @brief Binds the controller to its parts.
  /// @param parts parts of the controller
  explicit DirController(const Parts& parts);

  DirController(const DirController&) = delete;
  DirController& operator=(const DirController&) = delete;

  /// @brief Reads target and position, lets the state act, and writes the status. It is called when
  /// a measurement of the position ends, every 8 ms.
  /// @param motor state of the motor
  /// @isr{yes}
  /// @satisfies FR-114
  /// @satisfies FR-116
  void tick(const TurnFeedback& motor);

  /// @brief Returns whether an order to follow a set-point is in force. States call this method.
  /// @return true when the newest target is not a hold and is not older than 300 ms
  /// @isr{yes}
  /// @satisfies FR-106
  [[nodiscard]] bool following() const;

  /// @brief Returns whether orders have ceased. States call it.
  /// @return true when there is no target, or the newest target is older than 300 ms
  /// @isr{yes}
  /// @satisfies FR-109
  [[nodiscard]] bool abandoned() const;

  /// @brief Checks whether a release was ordered after the last change of state. States call it.
  /// @return true when the newest target is a release and is newer than the state
  /// @isr{yes}
  /// @satisfies FR-112
  [[nodiscard]] bool released() const;

  /// @brief Returns whether the position of the steering is unknown. States call it.
  /// @return true when there is no position, or the newest position is older than 20 ms
  /// @isr{yes}
  /// @satisfies FR-110
  [[nodiscard]] bool lost() const;

  /// @brief Checks whether the inputs of the steering contradict each other. This is true when both
  /// end stops are reached. It is also true when the position differs by more than 3 degrees from
  /// the position that results from the steps of the motor since it was switched on. The difference
  /// is reduced by 0.05 degrees in a second. States call it.
  /// @return true when they contradict each other
  /// @pre The position is not lost.
  /// @isr{yes}
  /// @satisfies FR-226
  /// @satisfies FR-227
  [[nodiscard]] bool inconsistent();

  /// @brief Starts to monitor whether the steering follows the steps of the motor. States call it.
  /// @pre The position is not lost.
  /// @isr{yes}
  /// @satisfies FR-111
  void watch();

  /// @brief Checks whether the steering fails to follow the steps of the motor. The check ends when
  /// 200 ms have passed and the steps amount to 0.6 degrees. Then the next window starts. States
  /// call it.
  /// @return true when the steering moved less than half of the angle of the steps
  /// @pre watch() was called, and the position is not lost.
  /// @isr{yes}
  /// @satisfies FR-111
  [[nodiscard]] bool stalled();

  /// @brief Returns the turn towards the target. States call it.
  /// @return rate of the algorithm [steps/s], -500 to 500; 0 without an order to follow, while the
  /// motor is not ready, and towards an end stop that is reached
  /// @pre The position is not lost.
  /// @isr{yes}
  /// @satisfies FR-101
  /// @satisfies FR-105
  /// @satisfies FR-107
  /// @satisfies FR-108
  [[nodiscard]] StepRate demand();

  /// @brief Returns whether the motor makes no steps. States call it.
  /// @return true when its rate is 0
  /// @isr{yes}
  /// @satisfies FR-101
  [[nodiscard]] bool atRest() const;

  /// @brief Switches the motor on. States call it.
  /// @isr{yes}
  /// @satisfies FR-106
  void enable();

  /// @brief Switches the motor off. States call it.
  /// @isr{yes}
  /// @satisfies FR-109
  /// @satisfies FR-110
  /// @satisfies FR-111
  void disable();

  /// @brief Sets the target speed of the motor. States call it.
  /// @param rate speed of the motor [steps/s], -500 to 500, positive to the left
  /// @isr{yes}
  /// @satisfies FR-101
  void turn(StepRate rate);

  /// @brief Sets the state. States call it.
  /// @param next state from the next tick on
  /// @isr{yes}
  void changeState(DirState& next);

 private:
  /// @brief Writes the state of the steering, with the time of this tick.
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
  // position and steps at the start of the window
  Instant watchedSince_{};
  std::int32_t watchedSteps_ = 0;
  Angle watchedPosition_{};
  // difference between position and steps since the motor was switched on
  std::optional<Angle> offset_;
  Instant forgottenAt_{};
};

}  // namespace wr
