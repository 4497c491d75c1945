#pragma once

#include "main_control/control_systems/ControlSystem.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief Builder of one control system.
///
/// @function Declares the build steps that every control system needs: for its actuator, its
/// sensors, its controller, and the control system itself.
///
/// @secret The parts of a control system, and the references between these parts.
///
/// @role{wheel-system-construction, Builder}
/// @role{steering-system-construction, Builder}
class ControlSystemBuilder {
 public:
  ControlSystemBuilder(const ControlSystemBuilder&) = delete;
  ControlSystemBuilder& operator=(const ControlSystemBuilder&) = delete;

  /// @brief Builds the actuator and the commands that move the actuator.
  /// @errors If the actuator is built twice, the program ends with the assertion PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  virtual void buildActuator() = 0;

  /// @brief Builds the sensors.
  /// @pre The actuator is built.
  /// @errors If this step uses a part that is missing, the program ends with the assertion
  /// PartMissing. If this step is called twice, the program ends with PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  virtual void buildSensors() = 0;

  /// @brief Builds the controller.
  /// @pre The actuator and the sensors are built.
  /// @errors If this step uses a part that is missing, the program ends with the assertion
  /// PartMissing. If this step is called twice, the program ends with PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  virtual void buildController() = 0;

  /// @brief Builds the control system from its parts.
  /// @pre The actuator, the sensors and the controller are built.
  /// @errors If a part is missing, the program ends with the assertion PartMissing. If this step is
  /// called twice, the program ends with PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  virtual void buildSystem() = 0;

  /// @brief Starts the interrupts and the threads that the control system has.
  /// @pre The control system is built.
  /// @errors If a part is missing, the program ends with the assertion PartMissing.
  /// @isr{no}
  /// @satisfies FR-92
  virtual void start() = 0;

  /// @brief Returns the control system that was built.
  /// @return the control system; it exists as long as the builder
  /// @pre buildSystem() was called.
  /// @errors If the control system is not built, the program ends with the assertion PartMissing.
  /// @isr{no}
  [[nodiscard]] virtual ControlSystem& system() = 0;

  /// @brief Returns the command that SecondTimer executes for this control system at each tick.
  /// @return the command; it exists as long as the builder
  /// @pre All parts are built.
  /// @errors If a part is missing, the program ends with the assertion PartMissing.
  /// @isr{no}
  [[nodiscard]] virtual Command& tickCommand() = 0;

 protected:
  ControlSystemBuilder() = default;
  ~ControlSystemBuilder() = default;
};

}  // namespace wr
