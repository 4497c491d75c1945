#pragma once

#include "construction/ControlSystemPoolBuilder.hpp"
#include "construction/MainControllerBuilder.hpp"
#include "devices/DigitalOutput.hpp"
#include "warning/WarningStates.hpp"

namespace wr {

/// @brief Builds a robot that warns before it stops, and starts it.
///
/// @function Calls the steps of the builders in the required sequence, replaces the standard
/// operation states by the states of this product, and starts the built parts.
///
/// @secret Which steps build a robot with a warning that the PC and the remote control command.
///
/// @role{pool-construction, Director}
/// @role{main-controller-construction, Director}
class WarningDirector final {
 public:
  /// @brief Binds the director to the builders and to the warning.
  /// @param poolBuilder builds the control systems
  /// @param controllerBuilder builds the main controller
  /// @param warning output that is on during a warning
  WarningDirector(ControlSystemPoolBuilder& poolBuilder, MainControllerBuilder& controllerBuilder,
                  DigitalOutput& warning);

  WarningDirector(const WarningDirector&) = delete;
  WarningDirector& operator=(const WarningDirector&) = delete;

  /// @brief Builds all parts of the robot.
  /// @post start() can be called.
  /// @errors A second call ends the program with the assertion PartBuiltTwice.
  /// @satisfies FR-152
  /// @isr{no}
  void construct();

  /// @brief Starts the control cycles.
  /// @pre construct() was called.
  /// @errors A robot that was not built ends the program with the assertion PartMissing.
  /// @satisfies FR-152
  /// @isr{no}
  void start();

 private:
  ControlSystemPoolBuilder& poolBuilder_;
  MainControllerBuilder& controllerBuilder_;
  WarningStates states_;
};

}  // namespace wr
