#pragma once

#include "construction/ControlSystemPoolBuilder.hpp"
#include "construction/MainControllerBuilder.hpp"

namespace wr {

/// @brief Builds the whole robot, and starts it.
///
/// @function Calls the steps of the builders in the required sequence, then starts the control
/// systems, the controller and the clocks.
///
/// @secret The sequence in which the parts of the robot are built and started.
///
/// @role{pool-construction, Director}
/// @role{main-controller-construction, Director}
class RobotDirector {
 public:
  /// @brief Binds the director to the builders.
  /// @param poolBuilder builds the control systems
  /// @param controllerBuilder builds the main controller
  RobotDirector(ControlSystemPoolBuilder& poolBuilder, MainControllerBuilder& controllerBuilder);

  /// @brief Builds all parts of a robot that receives orders from the PC and the remote control.
  /// @post start() can be called.
  /// @isr{no}
  void construct();

  /// @brief Builds all parts of a robot that receives orders only from the PC.
  /// @post start() can be called.
  /// @isr{no}
  /// @satisfies NFR-1
  void constructForPc();

  /// @brief Starts the control cycles.
  /// @pre construct() was called.
  /// @errors A robot that was not built ends the program with the assertion PartMissing.
  /// @satisfies FR-1
  /// @satisfies FR-10
  /// @isr{no}
  void start();

 private:
  void constructSystems();
  void constructController();

  ControlSystemPoolBuilder& poolBuilder_;
  MainControllerBuilder& controllerBuilder_;
};

}  // namespace wr
