#pragma once

#include <optional>

#include "construction/ControlSystemPoolBuilder.hpp"
#include "construction/MainControllerBuilder.hpp"
#include "safety/SafetyPcMode.hpp"
#include "safety/StopMemory.hpp"

namespace wr {

/// @brief The director of a robot that has safety functions and receives orders only from the PC.
///
/// @function Calls the steps of the builders in the required sequence. Passes one reading mode with
/// safety functions to the builder of the main controller, instead of the standard mode PC. Starts
/// the control systems and the main controller.
///
/// @secret The steps that build a robot with safety functions and without a remote control.
///
/// @role{pool-construction, Director}
/// @role{main-controller-construction, Director}
class SafetyPcDirector final {
 public:
  /// @param poolBuilder builds the control systems, with their safety functions
  /// @param controllerBuilder builds the main controller
  /// @param memory memory of a stop order of the PC
  SafetyPcDirector(ControlSystemPoolBuilder& poolBuilder, MainControllerBuilder& controllerBuilder,
                   StopMemory& memory);

  SafetyPcDirector(const SafetyPcDirector&) = delete;
  SafetyPcDirector& operator=(const SafetyPcDirector&) = delete;

  /// @brief Builds the control systems and the main controller.
  /// @post start() can be called.
  /// @errors A second call ends the program with the assertion PartBuiltTwice.
  /// @satisfies FR-293
  /// @isr{no}
  void construct();

  /// @brief Starts the control cycles.
  /// @pre construct() was called.
  /// @errors If construct() was not called, the program ends with the assertion PartMissing.
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
