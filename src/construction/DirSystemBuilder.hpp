#pragma once

#include <optional>

#include "construction/ControlSystemBuilder.hpp"
#include "devices/AnalogInput.hpp"
#include "devices/DigitalOutput.hpp"
#include "devices/EdgeInput.hpp"
#include "devices/Timebase.hpp"
#include "functions/SampledAngle.hpp"
#include "sensing/position/DirSensor.hpp"
#include "services/Pipe.hpp"
#include "steering_control/DirController.hpp"
#include "steering_control/DirCtrlTimeOut.hpp"
#include "steering_control/DirSystem.hpp"
#include "steering_control/SteeringDevice.hpp"
#include "steering_control/algorithms/DeadbandTurn.hpp"
#include "steering_control/commands/DisableSteering.hpp"
#include "steering_control/commands/EnableSteering.hpp"
#include "steering_control/commands/SetTurn.hpp"
#include "steering_control/power/PoweredOff.hpp"
#include "steering_control/power/PoweredOn.hpp"
#include "steering_control/states/DirFault.hpp"
#include "steering_control/states/DirHolding.hpp"
#include "steering_control/states/DirOff.hpp"
#include "steering_control/states/DirTurning.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Builder of the control system of the steering.
///
/// @function Builds the control system of the steering in four steps. The first step builds the
/// steering device with its power states and commands. The next steps build the position sensor,
/// then the controller with its states and its algorithm, and last the control system itself.
///
/// @secret The parts of the control system of the steering, the references between these parts, and
/// their storage.
///
/// @role{steering-system-construction, Concrete Builder}
/// @role{steering-commands, Client}
/// @role{steering-timer-interrupt, Client}
///
/// @patternapp{steering-system-construction, Builder, Building a steering device control system}
/// @why The control system of the steering consists of many parts that refer to each other.
/// ControlSystemPoolBuilder, which adds the control system to the pool, does not depend on these
/// parts.
/// @changes The parts of the control system and the references between them may change. Examples
/// are an additional state and a different sensor.
class DirSystemBuilder final : public ControlSystemBuilder {
 public:
  /// @brief Devices that the platform provides for the steering. Each device must exist as long as
  /// the builder.
  /// @datatype
  struct Devices {
    DigitalOutput& step;        ///< the motor makes a step each time this output is switched on
    DigitalOutput& direction;   ///< on: steps turn the steering to the left
    DigitalOutput& enable;      ///< on: the motor has current
    const EdgeInput& leftEnd;   ///< high: the left end stop is reached
    const EdgeInput& rightEnd;  ///< high: the right end stop is reached
    AnalogInput& angle;         ///< position of the steering
    const Timebase& timebase;   ///< returns the time
  };

  /// @param devices devices that the platform provides for the steering
  explicit DirSystemBuilder(const Devices& devices);

  void buildActuator() override;
  void buildSensors() override;
  void buildController() override;
  void buildSystem() override;
  void start() override;
  [[nodiscard]] ControlSystem& system() override;
  [[nodiscard]] Command& tickCommand() override;

 private:
  struct Actuator {
    explicit Actuator(const Devices& devices);
    PoweredOff poweredOff;
    PoweredOn poweredOn;
    SteeringDevice device;
    EnableSteering enable;
    DisableSteering disable;
    SetTurn setTurn;
  };
  struct Sensors {
    Sensors(const Devices& devices, Pipe<Angle>& positions);
    SampledAngle sampledAngle;
    DirSensor sensor;
  };
  struct Control {
    Control(const Devices& devices, Actuator& actuator, Pipe<DirTarget>& targets,
            Pipe<Angle>& positions, Pipe<DirStatus>& statuses);
    DeadbandTurn algorithm;
    DirHolding holding;
    DirOff off;
    DirTurning turning;
    DirFault fault;
    DirController controller;
  };
  struct System {
    System(const Devices& devices, Actuator& actuator, Sensors& sensors, Control& control,
           Pipe<DirTarget>& targets, Pipe<DirStatus>& statuses);
    DirCtrlTimeOut timeOut;
    DirSystem system;
  };

  Devices devices_;
  Pipe<DirTarget> targets_;
  Pipe<Angle> positions_;
  Pipe<DirStatus> statuses_;
  std::optional<Actuator> actuator_;
  std::optional<Sensors> sensors_;
  std::optional<Control> control_;
  std::optional<System> system_;
};

}  // namespace wr
