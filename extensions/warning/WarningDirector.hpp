#pragma once

#include "construction/ControlSystemPoolBuilder.hpp"
#include "construction/MainControllerBuilder.hpp"
#include "devices/DigitalOutput.hpp"
#include "warning/WarningStates.hpp"

namespace wr {

/// @brief The director of a robot that warns before it stops.
///
/// @function Calls the steps of the builders in the required sequence. Passes operation states with
/// a warning to the builder of the main controller, instead of the standard states. Starts the
/// control systems and the main controller.
///
/// @secret The steps that build a robot with a warning and a remote control.
///
/// @role{pool-construction, Director}
/// @role{main-controller-construction, Director}
class WarningDirector final {
 public:
  /// @param poolBuilder builds the control systems
  /// @param controllerBuilder builds the main controller
  /// @param warning output that is on while the robot warns
  WarningDirector(ControlSystemPoolBuilder& poolBuilder, MainControllerBuilder& controllerBuilder,
                  DigitalOutput& warning);

  WarningDirector(const WarningDirector&) = delete;
  WarningDirector& operator=(const WarningDirector&) = delete;

  /// @brief Builds the control systems and the main controller.
  /// @post start() can be called.
  /// @errors A second call ends the program with the assertion PartBuiltTwice.
  /// @satisfies FR-152
  /// @isr{no}
  void construct();

  /// @brief Starts the control cycles.
  /// @pre construct() was called.
  /// @errors If construct() was not called, the program ends with the assertion PartMissing.
  /// @satisfies FR-152
  /// @isr{no}
  void start();

 private:
  ControlSystemPoolBuilder& poolBuilder_;
  MainControllerBuilder& controllerBuilder_;
  WarningStates states_;
};

}  // namespace wr
