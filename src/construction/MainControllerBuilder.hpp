#pragma once

#include <array>
#include <optional>

#include "communication/pc_connection/Connected.hpp"
#include "communication/pc_connection/Disconnected.hpp"
#include "communication/pc_connection/Handshaking.hpp"
#include "communication/pc_connection/PcConnection.hpp"
#include "communication/serialization/BufferReader.hpp"
#include "communication/serialization/SerialReader.hpp"
#include "devices/FirstTimer.hpp"
#include "devices/PeriodicTimer.hpp"
#include "devices/SerialPort.hpp"
#include "devices/Timebase.hpp"
#include "devices/Watchdog.hpp"
#include "main_control/ControlData.hpp"
#include "main_control/ControllerTimeOut.hpp"
#include "main_control/MainController.hpp"
#include "main_control/control_systems/ControlSystemPool.hpp"
#include "main_control/operation_modes/BasicMode.hpp"
#include "main_control/operation_modes/PC.hpp"
#include "main_control/operation_modes/RC.hpp"
#include "main_control/operation_states/Reconnecting.hpp"
#include "main_control/operation_states/Waiting.hpp"
#include "main_control/operation_states/WaitingN.hpp"
#include "main_control/operation_states/Working.hpp"
#include "services/ControlThread.hpp"
#include "services/Pipe.hpp"
#include "services/StartRecord.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Makes the main controller and all its parts.
///
/// @function Makes the sources of orders, the link to the PC, the reading modes, the operation states, the
/// controller and its clock, one step each, and binds them. The sequence of the steps is that of
/// their declarations.
///
/// @secret Which parts the main controller has, how they are bound to each other, and where they are
/// stored.
///
/// @role{main-controller-construction, Builder}
/// @role{main-controller-construction, Concrete Builder}
/// @role{cycle-timer-interrupt, Client}
///
/// @patternapp{main-controller-construction, Builder, Building a main controller}
/// @why The main controller is made of many parts that refer to each other. Whoever starts the robot
/// needs to know none of them.
/// @changes The set of parts or the relations among them may change: a new device brings new parts that
/// the controller must get.
class MainControllerBuilder {
 public:
  /// @brief What the platform gives to the main controller. Each device lives as long as the builder.
  /// @datatype
  struct Devices {
    ControlThread& thread;       ///< runs the control cycles
    PeriodicTimer& cycleTimer;   ///< gives the clock pulses
    const Timebase& timebase;    ///< gives the time
    SerialPort& pcPort;          ///< line to the PC
    Pipe<Velocity>& rcVelocity;  ///< velocity signal of the remote control
    Pipe<Angle>& rcDirection;    ///< direction signal of the remote control
    Watchdog& watchdog;          ///< resets the system when cycles no longer complete
    const StartRecord& start;    ///< why the firmware started
  };

  /// @brief Binds the builder to the devices.
  /// @param devices devices of the platform
  explicit MainControllerBuilder(const Devices& devices);
  MainControllerBuilder(const MainControllerBuilder&) = delete;
  MainControllerBuilder& operator=(const MainControllerBuilder&) = delete;

  /// @brief Makes the readers of both sources of orders.
  /// @satisfies FR-51
  /// @isr{no}
  void buildReaders();

  /// @brief Makes the link to the PC and its states; it begins disconnected.
  /// @pre The readers are made.
  /// @errors A missing part ends the program with the assertion PartMissing.
  /// @isr{no}
  void buildConnection();

  /// @brief Makes the reading modes; each is the successor of the other.
  /// @pre The readers and the link are made.
  /// @errors A missing part ends the program with the assertion PartMissing.
  /// @satisfies FR-17
  /// @isr{no}
  void buildModes();

  /// @brief Makes the operation states and binds each to its successors.
  /// @isr{no}
  void buildStates();

  /// @brief Makes the controller; it begins in the state Working and the mode RC.
  /// @param systems what the controller controls
  /// @pre The link, the modes and the states are made.
  /// @errors A missing part ends the program with the assertion PartMissing.
  /// @satisfies FR-10
  /// @isr{no}
  void buildController(ControlSystemPool& systems);

  /// @brief Makes the timer that begins the control cycles, and its command.
  /// @pre The controller is made.
  /// @errors A missing part ends the program with the assertion PartMissing.
  /// @satisfies FR-1
  /// @isr{no}
  void buildClock();

  /// @brief Starts the controller, then the timer that begins its cycles.
  /// @pre The controller and its clock are made.
  /// @errors A missing part ends the program with the assertion PartMissing.
  /// @satisfies FR-1
  /// @isr{no}
  void start();

  /// @brief The controller that was made.
  /// @return the controller; it lives as long as the builder.
  /// @pre buildController() was called.
  /// @errors Without a controller the program ends with the assertion PartMissing.
  /// @isr{no}
  [[nodiscard]] MainController& controller();

  /// @brief The timer that begins the control cycles.
  /// @return the timer; it lives as long as the builder.
  /// @pre buildClock() was called.
  /// @errors Without a timer the program ends with the assertion PartMissing.
  /// @isr{no}
  [[nodiscard]] FirstTimer& clock();

 private:
  struct Readers {
    explicit Readers(const Devices& devices);
    SerialReader pc;
    BufferReader rc;
  };
  struct Link {
    Link(const Devices& devices, SerialReader& reader);
    Handshaking handshaking;
    Disconnected disconnected;
    Connected connected;
    PcConnection connection;
  };
  struct Modes {
    Modes(Readers& readers, const PcConnection& connection);
    BasicMode basicPc;
    BasicMode basicRc;
    PC pc;
    RC rc;
    std::array<Mode*, 2> all;
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
  std::optional<Readers> readers_;
  std::optional<Link> link_;
  std::optional<Modes> modes_;
  std::optional<States> states_;
  std::optional<MainController> controller_;
  std::optional<Clock> clock_;
};

}  // namespace wr
