#pragma once

#include "units/Measurements.hpp"

namespace wr {

class DirController;

/// @brief A state of the steering. The present state defines the work of the controller after each
/// measurement of the position.
/// @function Defines one interface for the work of the steering controller in all states.
/// @secret The differences between the states of the steering.
/// @role{steering-controller-states, State}
///
/// @patternapp{steering-controller-states, State, Operation states of the steering device controller}
/// @why The work of the steering controller depends on the state of the steering. Each state is a
/// module. Therefore one module contains all rules of one state.
/// @changes The actions of a state and its transitions may change. A new state may be needed, such
/// as a state that looks for the middle position after start.
class DirState {
 public:
  DirState(const DirState&) = delete;
  DirState& operator=(const DirState&) = delete;

  /// @brief Executes the work of this state after a measurement of the position, and changes the
  /// state of the controller if necessary.
  /// @param controller controller whose state changes
  /// @isr{yes}
  virtual void tick(DirController& controller) = 0;

  /// @brief Returns the identifier of this state.
  /// @return state, as in reports
  /// @isr{yes}
  /// @satisfies FR-116
  [[nodiscard]] SteeringState id() const;

 protected:
  /// @param id state, as in reports
  explicit DirState(SteeringState id);
  ~DirState() = default;

  /// @brief Checks whether the present state, in which the motor is on, must be left. If orders no
  /// longer arrive, switches the motor off and sets the state `off`. Otherwise, if the steering
  /// cannot be controlled, switches the motor off and sets the state `fault`.
  /// @param controller controller whose state changes
  /// @param off state that follows when orders no longer arrive
  /// @param fault state that follows when a fault occurs
  /// @return true if the state was left
  static bool leave(DirController& controller, DirState& off, DirState& fault);

 private:
  SteeringState id_;
};

}  // namespace wr
