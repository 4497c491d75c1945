#pragma once

#include <optional>

#include "construction/ControlSystemPoolBuilder.hpp"
#include "construction/MainControllerBuilder.hpp"
#include "devices/EdgeInput.hpp"
#include "devices/Timebase.hpp"
#include "remote_control/RcPin.hpp"
#include "safety/EnableChannel.hpp"
#include "safety/SafetyModes.hpp"
#include "safety/StopMemory.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief The director that builds and starts a robot with safety functions and a remote control.
///
/// @function Calls the steps of the builders in the required sequence. Passes reading modes with
/// safety functions to the builder of the main controller, instead of the standard modes PC and RC.
/// Starts the control systems and the main controller.
///
/// @secret The steps that build a robot with safety functions and a remote control.
///
/// @role{pool-construction, Director}
/// @role{main-controller-construction, Director}
/// @role{rc-pin-interrupt, Client}
class SafetyDirector final {
 public:
  /// @brief Devices of the safety functions. Each device must exist as long as the director.
  /// @datatype
  struct Devices {
    const Timebase& timebase;  ///< returns the present time
    const Timebase& edgeTime;  ///< returns the time of an edge of the remote control
    StopMemory& memory;        ///< memory of a stop order of the PC
    EdgeInput& enablePin;      ///< pin of the enable switch
    Pipe<Velocity>& velocity;  ///< position of the velocity stick
    Pipe<Angle>& direction;    ///< position of the direction stick
  };

  /// @param poolBuilder builds the control systems, with their safety functions
  /// @param controllerBuilder builds the main controller
  /// @param devices devices of the safety functions
  SafetyDirector(ControlSystemPoolBuilder& poolBuilder, MainControllerBuilder& controllerBuilder,
                 const Devices& devices);

  SafetyDirector(const SafetyDirector&) = delete;
  SafetyDirector& operator=(const SafetyDirector&) = delete;

  /// @brief Builds a robot that receives orders from the PC and the remote control.
  /// @post start() can be called.
  /// @errors A second call ends the program with the assertion PartBuiltTwice.
  /// @satisfies FR-285
  /// @satisfies FR-293
  /// @isr{no}
  void construct();

  /// @brief Starts the control cycles.
  /// @pre construct() was called.
  /// @errors If construct() was not called, the program ends with the assertion PartMissing.
  /// @satisfies FR-293
  /// @isr{no}
  void start();

  /// @brief Returns the pin of the enable switch.
  /// @return pin object; its function serve() handles the interrupts of the switch.
  /// @pre construct() was called.
  /// @errors If construct() was not called, the program ends with the assertion PartMissing.
  /// @satisfies FR-285
  /// @isr{yes}
  [[nodiscard]] RcPin& enablePin();

 private:
  ControlSystemPoolBuilder& poolBuilder_;
  MainControllerBuilder& controllerBuilder_;
  Devices devices_;
  std::optional<EnableChannel> enable_;
  std::optional<SafetyModes> modes_;
};

}  // namespace wr
