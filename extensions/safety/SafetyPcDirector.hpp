#pragma once

#include <optional>

#include "construction/ControlSystemPoolBuilder.hpp"
#include "construction/MainControllerBuilder.hpp"
#include "safety/SafetyPcMode.hpp"
#include "safety/StopMemory.hpp"

namespace wr {

/// @brief Builds a robot with safety functions that receives orders only from the PC, and starts it.
///
/// @function Calls the steps of the builders in the required sequence, replaces the standard
/// reading modes by the reading mode with safety functions, and starts the built parts.
///
/// @secret Which steps build a robot with safety functions that has no remote control.
///
/// @role{pool-construction, Director}
/// @role{main-controller-construction, Director}
class SafetyPcDirector final {
 public:
  /// @brief Binds the director to the builders and to the memory of the PC's stop.
  /// @param poolBuilder builds the control systems, with their safety functions
  /// @param controllerBuilder builds the main controller
  /// @param memory memory of the PC's stop
  SafetyPcDirector(ControlSystemPoolBuilder& poolBuilder, MainControllerBuilder& controllerBuilder,
                   StopMemory& memory);

  SafetyPcDirector(const SafetyPcDirector&) = delete;
  SafetyPcDirector& operator=(const SafetyPcDirector&) = delete;

  /// @brief Builds the robot.
  /// @post start() can be called.
  /// @errors A second call ends the program with the assertion PartBuiltTwice.
  /// @satisfies FR-293
  /// @isr{no}
  void construct();

  /// @brief Starts the control cycles.
  /// @pre construct() was called.
  /// @errors A robot that was not built ends the program with the assertion PartMissing.
  /// @satisfies FR-293
  /// @isr{no}
  void start();

 private:
  ControlSystemPoolBuilder& poolBuilder_;
  MainControllerBuilder& controllerBuilder_;
  StopMemory& memory_;
  std::optional<SafetyPcMode> mode_;
};

}  // namespace wr
