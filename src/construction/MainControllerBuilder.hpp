#pragma once

#include <array>
#include <optional>
#include <span>

#include "communication/pc_connection/Connected.hpp"
#include "communication/pc_connection/Disconnected.hpp"
#include "communication/pc_connection/Handshaking.hpp"
#include "communication/pc_connection/PcConnection.hpp"
#include "communication/serialization/BufferReader.hpp"
#include "communication/serialization/Reader.hpp"
#include "communication/serialization/SerialReader.hpp"
#include "devices/EdgeInput.hpp"
#include "devices/FirstTimer.hpp"
#include "devices/PeriodicTimer.hpp"
#include "devices/SerialPort.hpp"
#include "devices/Timebase.hpp"
#include "devices/Watchdog.hpp"
#include "functions/RcDirection.hpp"
#include "functions/RcVelocity.hpp"
#include "main_control/ControlData.hpp"
#include "main_control/ControllerTimeOut.hpp"
#include "main_control/MainController.hpp"
#include "main_control/control_systems/ControlSystemPool.hpp"
#include "main_control/operation_modes/BasicMode.hpp"
#include "main_control/operation_modes/Mode.hpp"
#include "main_control/operation_modes/PC.hpp"
#include "main_control/operation_modes/RC.hpp"
#include "main_control/operation_states/OperationState.hpp"
#include "main_control/operation_states/Reconnecting.hpp"
#include "main_control/operation_states/Waiting.hpp"
#include "main_control/operation_states/WaitingN.hpp"
#include "main_control/operation_states/Working.hpp"
#include "remote_control/DirectionBuffer.hpp"
#include "remote_control/RcPin.hpp"
#include "remote_control/ReadRcPin.hpp"
#include "remote_control/VelocityBuffer.hpp"
#include "sensing/instants/BasicCollector.hpp"
#include "sensing/instants/PeriodCollector.hpp"
#include "sensing/instants/WidthCollector.hpp"
#include "services/ControlThread.hpp"
#include "services/Pipe.hpp"
#include "services/StartRecord.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Builder of the main controller and all its parts.
///
/// @function Builds and connects the link to the PC, the remote control, the reading modes, the
/// operation states, the controller and the timer of its cycles. A product calls one build step for
/// each of these parts. The steps are declared in the sequence in which they are called. If a
/// product does not need a part, it omits the step of this part. An extension can build the reading
/// modes and the operation states itself.
///
/// @secret The parts of the main controller, the references between these parts, and their storage.
///
/// @role{main-controller-construction, Builder}
/// @role{main-controller-construction, Concrete Builder}
/// @role{cycle-timer-interrupt, Client}
/// @role{rc-pin-interrupt, Client}
///
/// @patternapp{main-controller-construction, Builder, Building a main controller}
/// @why The main controller consists of many parts that refer to each other. RobotDirector, which
/// calls the build steps, does not depend on these parts.
/// @changes The parts of the main controller and the references between them may change. For
/// example, a new device adds new parts to the controller.
class MainControllerBuilder {
 public:
  /// @brief Devices that the platform provides for the remote control. Each device must exist as
  /// long as the builder.
  /// @datatype
  struct RemoteControlDevices {
    EdgeInput& velocityPin;    ///< input that receives the pulses of the velocity stick
    EdgeInput& directionPin;   ///< input that receives the pulses of the direction stick
    Pipe<Velocity>& velocity;  ///< pipe for the velocity that is computed from the pulses
    Pipe<Angle>& direction;    ///< pipe for the steering angle that is computed from the pulses
    const Timebase* edgeTime = nullptr;  ///< returns the time of an edge; if this pointer is null,
                                         ///< the timebase of the main controller is used
  };

  /// @brief Devices that the platform provides for the main controller. Each device must exist as
  /// long as the builder.
  /// @datatype
  struct Devices {
    ControlThread& thread;      ///< runs the control cycles
    PeriodicTimer& cycleTimer;  ///< generates the clock pulses
    const Timebase& timebase;   ///< returns the time
    SerialPort& pcPort;         ///< serial line to the PC
    Watchdog& watchdog;         ///< resets the microcontroller if the control cycles are no longer
                                ///< completed
    const StartRecord& start;   ///< cause of the start of the firmware
    std::optional<RemoteControlDevices> remoteControl{};  ///< no devices in a product
                                                          ///< without remote control
  };

  /// @param devices devices that the platform provides for the main controller
  explicit MainControllerBuilder(Devices devices);
  MainControllerBuilder(const MainControllerBuilder&) = delete;
  MainControllerBuilder& operator=(const MainControllerBuilder&) = delete;

  /// @brief Builds the reader of the orders of the PC, the link to the PC, and the states of the
  /// connection. At first no PC is connected.
  /// @errors If the link is built twice, the program ends with the assertion PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  void buildConnection();

  /// @brief Builds the modules of the remote control: the pins, the interrupt handlers of the pins,
  /// and the reader of the orders. Enables the interrupts of the pins.
  /// @pre The platform provides the devices of the remote control.
  /// @errors If the platform does not provide the devices, the program ends with the assertion
  /// PartMissing. If this step is called twice, the program ends with PartBuiltTwice.
  /// @satisfies FR-51
  /// @satisfies FR-78
  /// @isr{no}
  void buildRemoteControl();

  /// @brief Builds the reading modes RC and PC. A change of the mode leads to the other mode. The
  /// firmware starts in RC.
  /// @pre The link and the remote control are built.
  /// @errors If a part is missing, the program ends with the assertion PartMissing. If modes are
  /// already built, the program ends with PartBuiltTwice.
  /// @satisfies FR-17
  /// @satisfies FR-78
  /// @isr{no}
  void buildModes();

  /// @brief Builds the reading mode PC for a product without other modes. A change of the mode sets
  /// the mode PC again, because there is no other mode.
  /// @pre The link is built.
  /// @errors If a part is missing, the program ends with the assertion PartMissing. If modes are
  /// already built, the program ends with PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  void buildPcMode();

  /// @brief Sets reading modes that an extension built.
  /// @param first reading mode in which the firmware starts
  /// @param all the reading modes; these modes and this array must exist as long as the builder
  /// @errors If modes are already built, the program ends with the assertion PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  void useModes(Mode& first, std::span<Mode* const> all);

  /// @brief Builds the operation states and connects each state to the states that can follow it.
  /// The firmware starts in Working.
  /// @errors If states are already built, the program ends with the assertion PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  void buildStates();

  /// @brief Sets operation states that an extension built.
  /// @param first operation state in which the firmware starts; it must exist as long as the
  /// builder
  /// @errors If states are already built, the program ends with the assertion PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  void useStates(OperationState& first);

  /// @brief Builds the main controller. The controller starts in the first operation state and the
  /// first reading mode.
  /// @param systems the control systems that the controller commands
  /// @pre The link, the modes and the states are built.
  /// @errors If a part is missing, the program ends with the assertion PartMissing. If the
  /// controller is built twice, the program ends with PartBuiltTwice.
  /// @satisfies FR-10
  /// @satisfies FR-78
  /// @isr{no}
  void buildController(ControlSystemPool& systems);

  /// @brief Builds the timer that begins the control cycles, and the command that this timer
  /// executes.
  /// @pre The controller is built.
  /// @errors If the controller is missing, the program ends with the assertion PartMissing. If the
  /// timer is built twice, the program ends with PartBuiltTwice.
  /// @satisfies FR-1
  /// @satisfies FR-78
  /// @isr{no}
  void buildClock();

  /// @brief Starts the controller, and then the timer that begins the control cycles.
  /// @pre The controller and the timer are built.
  /// @errors If a part is missing, the program ends with the assertion PartMissing.
  /// @satisfies FR-1
  /// @isr{no}
  void start();

  /// @brief Returns the controller that was built.
  /// @return the controller; it exists as long as the builder.
  /// @pre buildController() was called.
  /// @errors If the controller is not built, the program ends with the assertion PartMissing.
  /// @isr{no}
  /// @satisfies FR-78
  [[nodiscard]] MainController& controller();

  /// @brief Returns the timer that begins the control cycles.
  /// @return the timer; it exists as long as the builder.
  /// @pre buildClock() was called.
  /// @errors If the timer is not built, the program ends with the assertion PartMissing.
  /// @isr{yes}
  /// @satisfies FR-78
  [[nodiscard]] FirstTimer& clock();

  /// @brief Returns the reader of the orders of the PC.
  /// @return the reader; it exists as long as the builder.
  /// @pre buildConnection() was called.
  /// @errors If the reader is not built, the program ends with the assertion PartMissing.
  /// @isr{no}
  /// @satisfies FR-78
  [[nodiscard]] Reader& pcReader();

  /// @brief Returns the reader of the orders of the remote control.
  /// @return the reader; it exists as long as the builder.
  /// @pre buildRemoteControl() was called.
  /// @errors If the remote control is not built, the program ends with the assertion PartMissing.
  /// @isr{no}
  /// @satisfies FR-78
  [[nodiscard]] Reader& rcReader();

  /// @brief Returns the link to the PC.
  /// @return the link; it exists as long as the builder.
  /// @pre buildConnection() was called.
  /// @errors If the link is not built, the program ends with the assertion PartMissing.
  /// @isr{no}
  /// @satisfies FR-78
  [[nodiscard]] PcConnection& connection();

  /// @brief Returns the handler of the interrupts of the velocity pin.
  /// @return the pin; it exists as long as the builder.
  /// @pre buildRemoteControl() was called.
  /// @errors If the remote control is not built, the program ends with the assertion PartMissing.
  /// @isr{yes}
  /// @satisfies FR-78
  [[nodiscard]] RcPin& velocityPin();

  /// @brief Returns the handler of the interrupts of the direction pin.
  /// @return the pin; it exists as long as the builder.
  /// @pre buildRemoteControl() was called.
  /// @errors If the remote control is not built, the program ends with the assertion PartMissing.
  /// @isr{yes}
  /// @satisfies FR-78
  [[nodiscard]] RcPin& directionPin();

 private:
  struct Link {
    explicit Link(const Devices& devices);
    SerialReader reader;
    Handshaking handshaking;
    Disconnected disconnected;
    Connected connected;
    PcConnection connection;
  };
  struct RemoteControl {
    RemoteControl(const RemoteControlDevices& devices, const Timebase& timebase,
                  const Timebase& edgeTime);
    BasicCollector velocityInstants;
    PeriodCollector velocityPeriod;
    WidthCollector velocityWidth;
    RcVelocity rcVelocity;
    VelocityBuffer velocityBuffer;
    RcPin velocityPin;
    ReadRcPin readVelocityPin;
    BasicCollector directionInstants;
    PeriodCollector directionPeriod;
    WidthCollector directionWidth;
    RcDirection rcDirection;
    DirectionBuffer directionBuffer;
    RcPin directionPin;
    ReadRcPin readDirectionPin;
    BufferReader reader;
  };
  struct Modes {
    Modes(Reader& pcReader, Reader& rcReader, PcConnection& connection);
    BasicMode basicPc;
    BasicMode basicRc;
    PC pc;
    RC rc;
    std::array<Mode*, 2> all;
  };
  struct PcMode {
    PcMode(Reader& pcReader, PcConnection& connection);
    BasicMode basicPc;
    PC pc;
    std::array<Mode*, 1> all;
  };
  struct States {
    States();
    Waiting waiting;
    Working working;
    WaitingN waitingN;
    Reconnecting reconnecting;
  };
  struct Clock {
    Clock(PeriodicTimer& timer, MainController& controller);
    ControllerTimeOut timeOut;
    FirstTimer firstTimer;
  };

  Devices devices_;
  ControlData data_;
  std::optional<Link> link_;
  std::optional<RemoteControl> remoteControl_;
  std::optional<Modes> modes_;
  std::optional<PcMode> pcMode_;
  Mode* firstMode_ = nullptr;
  std::span<Mode* const> allModes_;
  std::optional<States> states_;
  OperationState* firstState_ = nullptr;
  std::optional<MainController> controller_;
  std::optional<Clock> clock_;
};

}  // namespace wr
