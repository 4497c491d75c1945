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

/// @brief Builds a robot with safety functions, and starts it.
///
/// @function Calls the steps of the builders in the required sequence, replaces the standard
/// reading modes by reading modes with safety functions, and starts the built parts.
///
/// @secret Which steps build a robot with safety functions.
///
/// @role{pool-construction, Director}
/// @role{main-controller-construction, Director}
/// @role{rc-pin-interrupt, Client}
class SafetyDirector final {
 public:
  /// @brief Devices of the safety functions. Each exists as long as the director.
  /// @datatype
  struct Devices {
    const Timebase& timebase;  ///< returns the time
    const Timebase& edgeTime;  ///< returns the time of an edge of the remote control
    StopMemory& memory;        ///< memory of the PC's stop
    EdgeInput& enablePin;      ///< pin of the enable switch
    Pipe<Velocity>& velocity;  ///< position of the velocity stick
    Pipe<Angle>& direction;    ///< position of the direction stick
  };

  /// @brief Binds the director to the builders and to the devices of the safety functions.
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
  /// @pre A robot was built.
  /// @errors A robot that was not built ends the program with the assertion PartMissing.
  /// @satisfies FR-293
  /// @isr{no}
  void start();

  /// @brief Returns the pin of the enable switch.
  /// @return pin that serves the interrupts of the switch.
  /// @pre construct() was called.
  /// @errors Without the pin the program ends with the assertion PartMissing.
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
