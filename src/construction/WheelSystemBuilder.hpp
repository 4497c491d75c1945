#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "construction/ControlSystemBuilder.hpp"
#include "devices/AnalogInput.hpp"
#include "devices/DigitalOutput.hpp"
#include "devices/EdgeInput.hpp"
#include "devices/PwmOutput.hpp"
#include "devices/Timebase.hpp"
#include "functions/HallVelocity.hpp"
#include "functions/SampledCurrent.hpp"
#include "sensing/current/CntSensor.hpp"
#include "sensing/current/ReadCnt.hpp"
#include "sensing/current/ValueCollector.hpp"
#include "sensing/instants/BasicCollector.hpp"
#include "sensing/instants/CountCollector.hpp"
#include "sensing/instants/PeriodCollector.hpp"
#include "sensing/velocity/ActiveSensor.hpp"
#include "sensing/velocity/CountSignal.hpp"
#include "sensing/velocity/SensorCollector.hpp"
#include "sensing/velocity/VelSensor.hpp"
#include "services/ControlThread.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"
#include "wheel_control/Wheel.hpp"
#include "wheel_control/WheelController.hpp"
#include "wheel_control/WheelSystem.hpp"
#include "wheel_control/algorithms/CurrentAlgorithm.hpp"
#include "wheel_control/algorithms/TensionAlgorithm.hpp"
#include "wheel_control/algorithms/VelocityAlgorithm.hpp"
#include "wheel_control/algorithms/WheelAlgorithm.hpp"
#include "wheel_control/behaviours/Advance.hpp"
#include "wheel_control/behaviours/Reverse.hpp"
#include "wheel_control/behaviours/SoftStart.hpp"
#include "wheel_control/behaviours/Stop.hpp"
#include "wheel_control/commands/SetOrientation.hpp"
#include "wheel_control/commands/SetTension.hpp"
#include "wheel_control/commands/StopWheel.hpp"
#include "wheel_control/orders/ApplyControl.hpp"
#include "wheel_control/orders/HaltWheel.hpp"
#include "wheel_control/orders/ReadCurrent.hpp"
#include "wheel_control/orders/ReadVelocity.hpp"
#include "wheel_control/orders/RegisterPosition.hpp"

namespace wr {

/// @brief Builder of the control system of one wheel.
///
/// @function Builds the control system of a wheel in four steps. The first step builds the wheel
/// with its commands. The next steps build the sensors of velocity and current, then the controller
/// with its algorithms and behaviours, and last the control system itself with the order objects
/// that it executes.
///
/// @secret The parts of the control system of a wheel, the references between these parts, and
/// their storage.
///
/// @role{wheel-system-construction, Concrete Builder}
/// @role{wheel-commands, Client}
/// @role{hall-interrupt, Client}
/// @role{wheel-timer-interrupt, Client}
///
/// @patternapp{wheel-system-construction, Builder, Building a wheel control system}
/// @why The control system of a wheel consists of many parts that refer to each other.
/// ControlSystemPoolBuilder, which adds the control system to the pool, does not depend on these
/// parts.
/// @changes The parts of the control system and the references between them may change. Examples
/// are a filter around a sensor and an additional algorithm.
class WheelSystemBuilder final : public ControlSystemBuilder {
 public:
  /// @brief Devices that the platform provides for a wheel. Each device must exist as long as the
  /// builder.
  /// @datatype
  struct Devices {
    PwmOutput& pwm;              ///< sets the voltage of the wheel
    DigitalOutput& orientation;  ///< on: the wheel turns backwards
    DigitalOutput& enable;       ///< on: the driver of the motor is enabled
    EdgeInput& hallA;            ///< first Hall sensor
    EdgeInput& hallB;            ///< second Hall sensor
    AnalogInput& current;        ///< current of the motor
    ControlThread& thread;       ///< runs the control system
    const Timebase& timebase;    ///< returns the time
    std::size_t wheel;           ///< number of the wheel, 0 to 3
  };

  /// @param devices devices that the platform provides for the wheel
  explicit WheelSystemBuilder(const Devices& devices);

  void buildActuator() override;
  void buildSensors() override;
  void buildController() override;
  void buildSystem() override;
  void start() override;
  [[nodiscard]] ControlSystem& system() override;
  [[nodiscard]] Command& tickCommand() override;

  /// @brief Sets algorithms that the controller uses in place of the builder's own algorithms.
  /// @param algorithms one algorithm for each WheelQuantity, in the sequence of the enumeration;
  /// the algorithms must exist as long as the builder
  /// @pre buildController() was not called.
  /// @errors If the controller is already built, the program ends with the assertion
  /// PartBuiltTwice.
  /// @isr{no}
  /// @satisfies FR-78
  void useAlgorithms(const std::array<WheelAlgorithm*, 3>& algorithms);

  /// @brief Returns the object that handles the interrupts of the Hall sensors.
  /// @return Hall sensors of the wheel; the object exists as long as the builder
  /// @pre buildSensors() was called.
  /// @errors If the sensors are not built, the program ends with the assertion PartMissing.
  /// @isr{yes}
  /// @satisfies FR-78
  [[nodiscard]] ActiveSensor& sensor();

 private:
  struct Actuator {
    explicit Actuator(const Devices& devices);
    Wheel wheel;
    StopWheel stopWheel;
    SetTension setTension;
    SetOrientation setOrientation;
  };
  struct Sensors {
    Sensors(const Devices& devices, Command& cutOff, Pipe<Velocity>& velocities,
            Pipe<Current>& currents);
    BasicCollector basic;
    PeriodCollector period;
    CountCollector count;
    SensorCollector collector;
    ActiveSensor active;
    CountSignal countSignal;
    HallVelocity hallVelocity;
    VelSensor velocity;
    ValueCollector values;
    ReadCnt readCnt;
    SampledCurrent sampledCurrent;
    CntSensor current;
  };
  struct Control {
    Control(const Devices& devices, Actuator& actuator, Pipe<Velocity>& velocities,
            Pipe<Current>& currents, const std::optional<std::array<WheelAlgorithm*, 3>>& given);
    TensionAlgorithm tension;
    CurrentAlgorithm current;
    VelocityAlgorithm velocity;
    Advance advance;
    SoftStart softStart;
    Stop stop;
    Reverse reverse;
    WheelController controller;
  };
  struct System {
    System(const Devices& devices, Actuator& actuator, Sensors& sensors, Control& control);
    RegisterPosition registerPosition;
    ReadVelocity readVelocity;
    ReadCurrent readCurrent;
    ApplyControl applyControl;
    HaltWheel haltWheel;
    WheelSystem system;
  };

  Devices devices_;
  Pipe<Velocity> velocities_;
  Pipe<Current> currents_;
  std::optional<std::array<WheelAlgorithm*, 3>> algorithms_;  // algorithms that useAlgorithms() set
  std::optional<Actuator> actuator_;
  std::optional<Sensors> sensors_;
  std::optional<Control> control_;
  std::optional<System> system_;
};

}  // namespace wr
