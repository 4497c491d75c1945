#pragma once

#include "units/Measurements.hpp"

namespace wr {

class DirController;

/// @brief A state of the steering: defines the work of the controller at a tick.
/// @function Defines one interface for the tick of the steering controller in all states.
/// @secret The differences between the states of the steering.
/// @role{steering-controller-states, State}
///
/// @patternapp{steering-controller-states, State, Operation states of the steering device controller}
/// @why The work of the steering controller at a tick depends on the state of the steering. Each
/// state is a module, so the rules of one state are in one place.
/// @changes The actions of a state, or its transitions. A new state, such as a state that searches
/// the middle after start.
class DirState {
 public:
  DirState(const DirState&) = delete;
  DirState& operator=(const DirState&) = delete;

  /// @brief Runs one tick, and changes the state when necessary.
  /// @param controller controller that ticks
  /// @isr{yes}
  virtual void tick(DirController& controller) = 0;

  /// @brief Returns the identifier of this state.
  /// @return state, as in reports
  /// @isr{yes}
  /// @satisfies FR-116
  [[nodiscard]] SteeringState id() const;

 protected:
  /// @brief Constructs a state with its identifier.
  /// @param id state, as in reports
  explicit DirState(SteeringState id);
  ~DirState() = default;

  /// @brief Leaves a state in which the motor is on, when necessary. Without orders the next state
  /// is off. When the steering cannot be controlled, the next state is fault.
  /// @param controller controller that ticks
  /// @param off state after the orders ended
  /// @param fault state after a fault
  /// @return true when the state was left
  static bool leave(DirController& controller, DirState& off, DirState& fault);

 private:
  SteeringState id_;
};

}  // namespace wr
