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

/// @brief Runs the control cycle: read, control, write.
///
/// @function Runs one cycle for each clock pulse. In each cycle it serves every source of orders,
/// lets the present operation state read one order, control and report, and reports to the watchdog
/// that the cycle completed. It stores the present state and the present reading mode, and executes
/// the orders of the states: apply control, hold, send a report.
///
/// @secret The sequence of steps in a control cycle, and the priority of a stop over every state.
///
/// @role{operation-states, Context}
/// @role{reading-modes, Context}
/// @role{cycle-timer-interrupt, Receiver}
/// @role{main-controller-construction, Product}
class MainController {
 public:
  /// @brief Parts of the controller. Each part exists as long as the controller.
  /// @datatype
  struct Parts {
    ControlThread& thread;         ///< runs the cycles
    const Timebase& timebase;      ///< returns the time of a clock pulse, and counts the cost of a
                                   ///< cycle
    ControlData& data;             ///< data of the cycle
    ControlSystemPool& systems;    ///< the control systems
    PcConnection& connection;      ///< link to the PC
    Watchdog& watchdog;            ///< is refreshed after each cycle that completed
    OperationState& initialState;  ///< operation state at start
    Mode& initialMode;             ///< reading mode at start
    std::span<Mode* const> modes;  ///< every mode: each is served in every cycle, and can order a
                                   ///< stop
  };

  /// @brief Binds the controller to its parts.
  /// @param parts parts of the controller
  /// @post The initial state and the initial mode are current; no cycle runs before start().
  /// @satisfies FR-10
  explicit MainController(const Parts& parts);
  MainController(const MainController&) = delete;
  MainController& operator=(const MainController&) = delete;

  /// @brief Starts the cycles: the thread runs one cycle for each clock pulse.
  /// @isr{no}
  /// @satisfies FR-1
  void start();

  /// @brief Records the time of a clock pulse and lets the thread run a cycle.
  /// @errors Before start() the pulse has no effect. A pulse that comes before the previous cycle
  /// has ended counts as an overrun; then at most one more cycle runs.
  /// @satisfies FR-1
  /// @satisfies FR-4
  /// @isr{yes}
  void clockPulse();

  /// @brief Reads the newest order, if an order is available, with the method of the present state.
  /// @post The current state is the result of the read.
  /// @satisfies FR-2
  /// @isr{no}
  void read();

  /// @brief Sends the orders of the present state to the control systems.
  /// @satisfies FR-2
  /// @satisfies FR-3
  /// @isr{no}
  void control();

  /// @brief Sends the report of the present state.
  /// @satisfies FR-2
  /// @satisfies FR-3
  /// @isr{no}
  void write();

  /// @brief Sets the operation state.
  /// @param state state for the next steps
  /// @isr{no}
  void changeOpState(OperationState& state);

  /// @brief Sets the reading mode.
  /// @param mode mode for the next reads
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

  /// @brief Orders the control systems to follow the set-points that were read last. An order to
  /// acknowledge moves nothing. It is valid only if all its values are neutral.
  /// @post Without set-points, and while a stop is in force, the control systems are held.
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
  /// @errors A report that the link cannot send is dropped; the link counts it.
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
  /// write. If the cycle completed, it refreshes the watchdog at the end.
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
  /// @brief Saves which sources order stop.
  /// @satisfies FR-21
  void noteStop();
  /// @brief Saves whether the present cycle overran.
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
  Pipe<std::uint32_t> pulses_;  // count of processor cycles at a clock pulse, with its time
  std::uint16_t seenOverruns_ = 0;
};

}  // namespace wr
