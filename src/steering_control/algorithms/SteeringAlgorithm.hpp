#pragma once

#include "units/quantities.hpp"

namespace wr {

/// @brief A rule that turns the steering to an angle.
/// @function Computes the turn of the steering from the target, the position and the speed of the
/// motor.
/// @secret The rule that computes the turn from target and position.
/// @role{steering-control-algorithm, Strategy}
///
/// @patternapp{steering-control-algorithm, Strategy, Control algorithm for the steering device}
/// @why A rule decides in which direction the steering turns. The rule is an object that is passed
/// to the controller. Therefore the rule can be improved without a change to the controller.
/// @changes The rule or its constants may change. A second rule may be needed, for example for
/// another motor.
class SteeringAlgorithm {
 public:
  SteeringAlgorithm(const SteeringAlgorithm&) = delete;
  SteeringAlgorithm& operator=(const SteeringAlgorithm&) = delete;

  /// @brief Computes the target speed of the motor.
  /// @param target target angle [0.01 degree], positive to the left
  /// @param position present angle [0.01 degree], positive to the left
  /// @param now present speed of the motor [steps/s], -500 to 500, positive to the left
  /// @return target speed of the motor [steps/s], -500 to 500, positive to the left; if the motor
  /// is at rest, 0 means that the steering has reached its target
  /// @isr{yes}
  [[nodiscard]] virtual StepRate turn(Angle target, Angle position, StepRate now) = 0;

 protected:
  SteeringAlgorithm() = default;
  ~SteeringAlgorithm() = default;
};

}  // namespace wr
