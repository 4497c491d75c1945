#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "sim/board_robot/BoardSession.hpp"
#include "sim/emulator/CallRecorder.hpp"
#include "sim/emulator/EventTrace.hpp"
#include "sim/scenario/Scenario.hpp"
#include "sim/scenario/ScenarioPlayer.hpp"
#include "sim/web/RecordedLine.hpp"

namespace wr::web {

/// @brief A firmware image on the virtual board in the simulated robot. The object plays a
/// scenario. The user can execute further actions.
class LiveRobot {
 public:
  /// @brief Inputs of a run.
  struct Setup {
    std::vector<std::uint8_t> image;       ///< content of the flash from address 0
    std::vector<std::uint32_t> functions;  ///< addresses of the functions whose calls are recorded
    std::string scenario;                  ///< text of the scenario
    std::string name;                      ///< name of the scenario in messages
    bool resetsAreFindings = true;         ///< true: the run stops when the program causes a reset
    bool verifies = false;  ///< true: all events are traced, and the table of reports is written
  };

  enum class State : std::uint8_t { Runs, Ended, Found };

  /// @brief The instant at which an interrupt or a thread begins or ends.
  struct Switch {
    std::uint32_t exception = 0;  ///< number of the exception
    bool entered = false;         ///< true: the exception begins; false: it ends
    std::uint32_t at = 0;         ///< time since the start of the cycle [ns]
  };

  /// @brief The last call of a function.
  struct LastCall {
    std::chrono::nanoseconds at{-1};           ///< time of the board; -1: not called yet
    std::array<std::uint32_t, 4> registers{};  ///< core registers 0 to 3 at the first instruction
  };

  /// @brief The recorded calls from one clock pulse to the next.
  struct Cycle {
    std::vector<std::uint32_t>
        calls;                 ///< addresses of functions; bit 0 is set when the function is left
    std::uint64_t cycles = 0;  ///< processor cycles
    std::uint64_t awake = 0;   ///< processor cycles without sleep
    std::uint32_t hash =
        0;  ///< hash of the calls; two cycles with the same calls have the same hash
    bool truncated = false;        ///< true: the cycle had more calls than were recorded
    std::vector<Switch> switches;  ///< all switches of the cycle, in the order of time
    /// Last call of each function since the start, in the order of Setup::functions. The call
    /// may be missing in `calls`: if several interrupts make the same calls in a cycle, `calls`
    /// contains only the calls of the first of these interrupts.
    std::vector<LastCall> lastCalls;
  };

  /// @brief Switches the robot on. Throws Scenario::Error.
  explicit LiveRobot(Setup setup);
  LiveRobot(const LiveRobot&) = delete;
  LiveRobot& operator=(const LiveRobot&) = delete;

  /// @brief Runs until a control cycle has ended. The run ends earlier at the end of the scenario,
  /// at a finding, or after 200 ms without a clock pulse.
  State runCycle();

  /// @brief Runs to the end of the scenario, or until a finding stops the board.
  State runToEnd();

  /// @brief Executes one action of a scenario now. The text of the action has no time. Throws
  /// Scenario::Error.
  void perform(const std::string& action);

  /// @brief Sets the order of the PC. As soon as the robot sends reports, the PC sends this order
  /// every 100 ms. Throws Scenario::Error.
  /// @param order the order as in a scenario; if it is empty, the PC sends nothing
  void repeat(const std::string& order);

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] const board_robot::BoardSession& session() const { return session_; }
  [[nodiscard]] const scenario::ScenarioPlayer& player() const { return player_; }

  /// @brief Returns the last control cycle that has ended.
  [[nodiscard]] const Cycle& cycle() const { return cycle_; }

  /// @brief Returns the number of calls of each function, in the order of Setup::functions. If
  /// several interrupts make the same calls in a cycle, these calls are counted once.
  [[nodiscard]] const std::vector<std::uint32_t>& entries() const { return entries_; }

  /// @brief Returns the bytes that the PC and the robot have sent since the last call of this
  /// method.
  [[nodiscard]] std::vector<RecordedLine::Piece> takePieces() { return line_.takePieces(); }

  /// @brief Returns all events of the board; empty without Setup::verifies.
  [[nodiscard]] const emulator::EventTrace& events() const { return events_; }

  /// @brief Returns the table of reports; empty without Setup::verifies.
  [[nodiscard]] std::string reports() const { return reports_.str(); }

  /// @brief Returns the true values, in the order of truthFields().
  [[nodiscard]] std::vector<double> truth();

 private:
  void take(const emulator::Event& event);
  void noteCall(std::uint32_t function);
  void endCycle();
  void sendOrder();
  void step();

  Setup setup_;
  emulator::EventTrace events_;
  std::ostringstream reports_;
  scenario::Scenario scenario_;
  emulator::CallRecorder recorder_;
  board_robot::BoardSession session_;
  RecordedLine line_;
  scenario::ScenarioPlayer player_;
  std::optional<scenario::Scenario::Action> order_;
  scenario::RobotSession::Time orderAt_{};
  Cycle cycle_;
  std::vector<Switch> switches_;  // switches since the start of the present cycle
  std::chrono::nanoseconds pulseAt_{};
  std::uint64_t beganAt_ = 0;      // processor cycle
  std::uint64_t sleptBefore_ = 0;  // processor cycles
  std::vector<std::uint32_t> entries_;
  std::vector<LastCall> lastCalls_;
  bool cycleEnded_ = false;
  State state_ = State::Runs;
};

}  // namespace wr::web
