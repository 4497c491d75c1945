#pragma once

#include "main_control/control_systems/ControlSystem.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief Builds one control system.
///
/// @function Defines the same steps of construction for every control system: its sensors, its
/// actuator, its controller, and the system itself.
///
/// @secret Which parts a control system has, and how they are bound to each other.
///
/// @role{wheel-system-construction, Builder}
/// @role{steering-system-construction, Builder}
class ControlSystemBuilder {
 public:
  ControlSystemBuilder(const ControlSystemBuilder&) = delete;
  ControlSystemBuilder& operator=(const ControlSystemBuilder&) = delete;

  /// @brief Builds the actuator, with the commands that move it.
  /// @errors A part that is built twice ends the program with the assertion PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  virtual void buildActuator() = 0;

  /// @brief Builds the sensors.
  /// @pre The actuator is built.
  /// @errors A missing part ends the program with the assertion PartMissing. A part that is built
  /// twice ends the program with PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  virtual void buildSensors() = 0;

  /// @brief Builds the controller.
  /// @pre The actuator and the sensors are built.
  /// @errors A missing part ends the program with the assertion PartMissing. A part that is built
  /// twice ends the program with PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  virtual void buildController() = 0;

  /// @brief Builds the system.
  /// @pre All its parts are built.
  /// @errors A missing part ends the program with the assertion PartMissing. A part that is built
  /// twice ends the program with PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  virtual void buildSystem() = 0;

  /// @brief Starts the interrupts and the thread of the system.
  /// @pre The system is built.
  /// @errors A missing part ends the program with the assertion PartMissing.
  /// @isr{no}
  /// @satisfies FR-92
  virtual void start() = 0;

  /// @brief Returns the system that was built.
  /// @return the system; it exists as long as the builder
  /// @pre buildSystem() was called.
  /// @errors Without a system the program ends with the assertion PartMissing.
  /// @isr{no}
  [[nodiscard]] virtual ControlSystem& system() = 0;

  /// @brief Returns the command that does the work of the system at each tick of the second timer.
  /// @return the command; it exists as long as the builder
  /// @pre All parts are built.
  /// @errors A missing part ends the program with the assertion PartMissing.
  /// @isr{no}
  [[nodiscard]] virtual Command& tickCommand() = 0;

 protected:
  ControlSystemBuilder() = default;
  ~ControlSystemBuilder() = default;
};

}  // namespace wr
