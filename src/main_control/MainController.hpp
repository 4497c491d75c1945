#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "communication/pc_connection/PcConnection.hpp"
#include "devices/Timebase.hpp"
#include "devices/Watchdog.hpp"
#include "main_control/ControlData.hpp"
#include "main_control/control_systems/ControlSystemPool.hpp"
#include "main_control/operation_modes/Mode.hpp"
#include "main_control/operation_states/OperationState.hpp"
#include "services/Command.hpp"
#include "services/ControlThread.hpp"
#include "services/Pipe.hpp"

namespace wr {

/// @brief Main controller, which runs the control cycle: read, control, write.
///
/// @function Runs one cycle for each clock pulse. In each cycle, serves every source of orders, and
/// lets the present operation state read at most one order, control the robot and send the report.
/// Refreshes the watchdog after each completed cycle. Stores the present operation state and the
/// present reading mode. Carries out the orders of the states: apply control, hold, send a report.
///
/// @secret The sequence of steps in a control cycle, and the rule that a stop has priority in every
/// state.
///
/// @role{operation-states, Context}
/// @role{reading-modes, Context}
/// @role{cycle-timer-interrupt, Receiver}
/// @role{main-controller-construction, Product}
class MainController {
 public:
  /// @brief Parts of the controller. Each part must exist for as long as the controller exists.
  /// @datatype
  struct Parts {
    ControlThread& thread;         ///< runs the cycles
    const Timebase& timebase;      ///< returns the time, and counts processor cycles
    ControlData& data;             ///< data of the cycle
    ControlSystemPool& systems;    ///< the control systems
    PcConnection& connection;      ///< link to the PC
    Watchdog& watchdog;            ///< timer that each completed cycle refreshes
    OperationState& initialState;  ///< operation state at start
    Mode& initialMode;             ///< reading mode at start
    std::span<Mode* const> modes;  ///< all reading modes; in every cycle, the controller serves
                                   ///< each mode, and checks whether a stop of it is in force
  };

  /// @param parts parts of the controller
  /// @post The controller is in the initial state and in the initial mode. No cycle runs before
  /// start().
  /// @satisfies FR-10
  explicit MainController(const Parts& parts);
  MainController(const MainController&) = delete;
  MainController& operator=(const MainController&) = delete;

  /// @brief Starts the cycles: the thread runs one cycle for each clock pulse.
  /// @isr{no}
  /// @satisfies FR-1
  void start();

  /// @brief Records the time of a clock pulse and lets the thread run a cycle.
  /// @errors Before start() the pulse has no effect. If a pulse occurs before the previous cycle
  /// has ended, this is an overrun. Even if several pulses occur before the previous cycle has
  /// ended, only one more cycle runs after this cycle.
  /// @satisfies FR-1
  /// @satisfies FR-4
  /// @isr{yes}
  void clockPulse();

  /// @brief Reads the newest order, if an order is available. The present operation state carries
  /// out this step.
  /// @post The operation state is the state that results from this read.
  /// @satisfies FR-2
  /// @isr{no}
  void read();

  /// @brief Sends orders to the control systems. The present operation state selects these orders.
  /// @satisfies FR-2
  /// @satisfies FR-3
  /// @isr{no}
  void control();

  /// @brief Sends the report of this cycle. The present operation state carries out this step.
  /// @satisfies FR-2
  /// @satisfies FR-3
  /// @isr{no}
  void write();

  /// @brief Sets the operation state.
  /// @param state operation state that applies from the next step
  /// @isr{no}
  void changeOpState(OperationState& state);

  /// @brief Sets the reading mode.
  /// @param mode reading mode that applies from the next read
  /// @satisfies FR-11
  /// @satisfies FR-12
  /// @isr{no}
  void changeMode(Mode& mode);

  /// @brief Returns the present reading mode.
  /// @return mode from which orders are read.
  /// @isr{no}
  /// @satisfies FR-13
  [[nodiscard]] Mode& getMode();

  /// @brief Returns the data of the present cycle.
  /// @return data in which modes and states store values.
  /// @isr{no}
  /// @satisfies FR-61
  [[nodiscard]] ControlData& getData();

  /// @brief Orders the control systems to follow the set-points that were read last. If these
  /// set-points belong to an order to acknowledge, the control systems are held. They then release
  /// latched faults if three conditions are met: this order was read in this cycle, this order is
  /// neutral, and no stop is in force.
  /// @post The control systems are held if there are no set-points or if a stop is in force.
  /// @satisfies FR-14
  /// @satisfies FR-21
  /// @satisfies FR-22
  /// @satisfies FR-299
  /// @isr{no}
  void applyControl();

  /// @brief Orders the control systems to halt the wheels and to hold the steering.
  /// @satisfies FR-18
  /// @satisfies FR-21
  /// @isr{no}
  void holdSystems();

  /// @brief Sends the report of this cycle to the PC.
  /// @param state operation state to report
  /// @errors If the link cannot send the report, it drops and counts the report.
  /// @satisfies FR-4
  /// @satisfies FR-5
  /// @satisfies FR-60
  /// @satisfies FR-61
  /// @satisfies FR-160
  /// @isr{no}
  void sendReport(OperationStateId state);

 private:
  class Body final : public Command {
   public:
    explicit Body(MainController& mCtrl);
    void execute() override;

   private:
    MainController& mCtrl_;
  };

  /// @brief Runs one control cycle: serve the sources of orders, record stops, read, control,
  /// write. At the end, refreshes the watchdog if all control systems have completed their work.
  /// @satisfies FR-2
  /// @satisfies FR-35
  /// @satisfies FR-37
  /// @satisfies FR-74
  /// @satisfies FR-302
  /// @satisfies FR-303
  /// @satisfies FR-304
  void cycle();
  /// @brief Lets every source of orders process its input.
  /// @satisfies FR-35
  void serveSources();
  /// @brief Records the sources that order a stop.
  /// @satisfies FR-21
  void noteStop();
  /// @brief Records an overrun if a clock pulse occurred before the previous cycle had ended, or if
  /// a control system has not completed its work.
  /// @satisfies FR-4
  /// @satisfies FR-5
  void noteOverrun();

  Body body_;
  ControlThread& thread_;
  const Timebase& timebase_;
  ControlData& data_;
  ControlSystemPool& systems_;
  PcConnection& connection_;
  Watchdog& watchdog_;
  std::reference_wrapper<OperationState> opSt_;
  std::reference_wrapper<Mode> mode_;
  std::span<Mode* const> modes_;
  Pipe<std::uint32_t> pulses_;  // count of processor cycles at a clock pulse, and time of the pulse
  std::uint32_t seenOverruns_ = 0;
};

}  // namespace wr
