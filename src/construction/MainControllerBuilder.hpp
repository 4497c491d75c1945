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

/// @brief Builds the main controller and all its parts.
///
/// @function Builds the link to the PC, the remote control, the reading modes, the operation
/// states, the controller and its clock, with one step for each, and binds them. The sequence of
/// the steps is the sequence of their declarations. A product without a part omits its step. An
/// extension can build modes and states.
///
/// @secret Which parts the main controller has, how they are bound to each other, and where they are
/// stored.
///
/// @role{main-controller-construction, Builder}
/// @role{main-controller-construction, Concrete Builder}
/// @role{cycle-timer-interrupt, Client}
/// @role{rc-pin-interrupt, Client}
///
/// @patternapp{main-controller-construction, Builder, Building a main controller}
/// @why The main controller consists of many parts that refer to each other. The module that starts
/// the robot does not depend on these parts.
/// @changes The set of parts or the relations among them may change: a new device adds new parts to
/// the controller.
class MainControllerBuilder {
 public:
  /// @brief Devices that the platform provides for the remote control. Each device exists as long as the builder.
  /// @datatype
  struct RemoteControlDevices {
    EdgeInput& velocityPin;    ///< pulses of the velocity lever
    EdgeInput& directionPin;   ///< pulses of the direction lever
    Pipe<Velocity>& velocity;  ///< velocity from the pulses
    Pipe<Angle>& direction;    ///< direction from the pulses
    const Timebase* edgeTime =
        nullptr;  ///< returns the time of an edge; null: the timebase of all devices returns it
  };

  /// @brief Devices that the platform provides for the main controller. Each device exists as long as the builder.
  /// @datatype
  struct Devices {
    ControlThread& thread;      ///< runs the control cycles
    PeriodicTimer& cycleTimer;  ///< generates the clock pulses
    const Timebase& timebase;   ///< returns the time
    SerialPort& pcPort;         ///< line to the PC
    Watchdog& watchdog;         ///< resets the system when cycles no longer complete
    const StartRecord& start;   ///< cause of the start of the firmware
    std::optional<RemoteControlDevices> remoteControl{};  ///< nothing in a product without remote
                                                          ///< control
  };

  /// @brief Binds the builder to the devices.
  /// @param devices devices of the platform
  explicit MainControllerBuilder(Devices devices);
  MainControllerBuilder(const MainControllerBuilder&) = delete;
  MainControllerBuilder& operator=(const MainControllerBuilder&) = delete;

  /// @brief Builds the reader of the PC's orders, and the link to the PC with its states. The link
  /// begins disconnected.
  /// @errors A link that is built twice ends the program with the assertion PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  void buildConnection();

  /// @brief Builds the remote control: its pins, their interrupt handlers, and the reader of its orders.
  /// The interrupts of the pins are enabled from now on.
  /// @pre The platform provides the devices of the remote control.
  /// @errors Without devices the program ends with the assertion PartMissing. A second call ends
  /// the program with PartBuiltTwice.
  /// @satisfies FR-51
  /// @satisfies FR-78
  /// @isr{no}
  void buildRemoteControl();

  /// @brief Builds the reading modes PC and RC; each is the successor of the other. RC is the first.
  /// @pre The link and the remote control are built.
  /// @errors A missing part ends the program with the assertion PartMissing. Modes that are already
  /// built end the program with PartBuiltTwice.
  /// @satisfies FR-17
  /// @satisfies FR-78
  /// @isr{no}
  void buildModes();

  /// @brief Builds the reading mode PC for a product without other modes: a change of the mode
  /// leads to PC again.
  /// @pre The link is built.
  /// @errors A missing part ends the program with the assertion PartMissing. Modes that are already
  /// built end the program with PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  void buildPcMode();

  /// @brief Sets reading modes that an extension built.
  /// @param first mode at start
  /// @param all every mode; storage and modes exist as long as the builder
  /// @errors Modes that are already built end the program with the assertion PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  void useModes(Mode& first, std::span<Mode* const> all);

  /// @brief Builds the operation states and binds each to its successors. Working is the first.
  /// @errors States that are already built end the program with the assertion PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  void buildStates();

  /// @brief Sets operation states that an extension built.
  /// @param first state at start; it exists as long as the builder
  /// @errors States that are already built end the program with the assertion PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  void useStates(OperationState& first);

  /// @brief Builds the controller; it begins in the first state and the first mode.
  /// @param systems the control systems of the controller
  /// @pre The link, the modes and the states are built.
  /// @errors A missing part ends the program with the assertion PartMissing. A second controller ends
  /// the program with PartBuiltTwice.
  /// @satisfies FR-10
  /// @satisfies FR-78
  /// @isr{no}
  void buildController(ControlSystemPool& systems);

  /// @brief Builds the timer that begins the control cycles, and its command.
  /// @pre The controller is built.
  /// @errors A missing part ends the program with the assertion PartMissing. A second timer ends
  /// the program with PartBuiltTwice.
  /// @satisfies FR-1
  /// @satisfies FR-78
  /// @isr{no}
  void buildClock();

  /// @brief Starts the controller, then the timer that begins its cycles.
  /// @pre The controller and its clock are built.
  /// @errors A missing part ends the program with the assertion PartMissing.
  /// @satisfies FR-1
  /// @isr{no}
  void start();

  /// @brief Returns the controller that was built.
  /// @return the controller; it exists as long as the builder.
  /// @pre buildController() was called.
  /// @errors Without a controller the program ends with the assertion PartMissing.
  /// @isr{no}
  /// @satisfies FR-78
  [[nodiscard]] MainController& controller();

  /// @brief Returns the timer that begins the control cycles.
  /// @return the timer; it exists as long as the builder.
  /// @pre buildClock() was called.
  /// @errors Without a timer the program ends with the assertion PartMissing.
  /// @isr{yes}
  /// @satisfies FR-78
  [[nodiscard]] FirstTimer& clock();

  /// @brief Returns the reader of the PC's orders.
  /// @return the reader; it exists as long as the builder.
  /// @pre buildConnection() was called.
  /// @errors Without a reader the program ends with the assertion PartMissing.
  /// @isr{no}
  /// @satisfies FR-78
  [[nodiscard]] Reader& pcReader();

  /// @brief Returns the reader of the remote control's orders.
  /// @return the reader; it exists as long as the builder.
  /// @pre buildRemoteControl() was called.
  /// @errors Without a remote control the program ends with the assertion PartMissing.
  /// @isr{no}
  /// @satisfies FR-78
  [[nodiscard]] Reader& rcReader();

  /// @brief Returns the link to the PC.
  /// @return the link; it exists as long as the builder.
  /// @pre buildConnection() was called.
  /// @errors Without a link the program ends with the assertion PartMissing.
  /// @isr{no}
  /// @satisfies FR-78
  [[nodiscard]] PcConnection& connection();

  /// @brief Returns the handler of the interrupts of the velocity pin.
  /// @return the pin; it exists as long as the builder.
  /// @pre buildRemoteControl() was called.
  /// @errors Without a remote control the program ends with the assertion PartMissing.
  /// @isr{yes}
  /// @satisfies FR-78
  [[nodiscard]] RcPin& velocityPin();

  /// @brief Returns the handler of the interrupts of the direction pin.
  /// @return the pin; it exists as long as the builder.
  /// @pre buildRemoteControl() was called.
  /// @errors Without a remote control the program ends with the assertion PartMissing.
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
