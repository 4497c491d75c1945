#pragma once

#include "construction/ControlSystemPoolBuilder.hpp"
#include "construction/MainControllerBuilder.hpp"

namespace wr {

/// @brief Director that builds and starts the whole robot.
///
/// @function Calls the build steps of the builders in the required sequence. Then starts the
/// control systems, the main controller and their timers.
///
/// @secret The sequence in which the parts of the robot are built and started.
///
/// @role{pool-construction, Director}
/// @role{main-controller-construction, Director}
class RobotDirector {
 public:
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

  /// @brief Starts the control systems and the control cycles.
  /// @pre construct() or constructForPc() was called.
  /// @errors If the robot was not built, the program ends with the assertion PartMissing.
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
