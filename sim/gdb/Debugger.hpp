#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sim/emulator/DebugPort.hpp"
#include "sim/gdb/StopRules.hpp"

namespace wr::gdb {

/// @brief An exception that is thrown when a run restarts. The owner of the board constructs a new
/// board, passes it to begin(), and runs it as before.
struct BeginsAgain {};

/// @brief A debugger that stops the program and can return to an earlier time.
///
/// A position is a number of executed instructions. The same input causes the same run. To go back
/// to an earlier position, the debugger starts a new run from the beginning. Therefore the
/// debugger need not restore any state.
class Debugger {
 public:
  /// @brief Serves the user while the program is stopped.
  ///
  /// The function returns when the program shall continue. The parameter `why` is the reason for
  /// the stop, in the form of a GDB stop reply, e.g. `05` or `05watch:20000004;`.
  using Serve = std::function<void(const std::string& why)>;

  /// @param serve is called at each stop, before an instruction or after the end of the run
  /// @param asked returns true if the user requests a stop of the program
  Debugger(Serve serve, std::function<bool()> asked);

  /// @brief Begins a run. The first run stops before its first instruction.
  /// @param port the board that runs; must outlive the run
  void begin(emulator::DebugPort& port);

  /// @brief Reports the end of the run. The program stops a last time. It can then only run
  /// backwards.
  /// @param why as in Serve
  void end(const std::string& why);

  /// @brief Stops the program at its present position. This function is called while the program
  /// waits for an interrupt.
  void stopHere(const std::string& why) { stop(why); }

  // The commands of the user at a stop. Without a command, the program runs to the next stop. If a
  // command goes back, it throws BeginsAgain.
  void step();
  void stepBack();
  void resumeBack();
  void runTo(std::chrono::nanoseconds time);
  void restart();

  /// @brief Removes all breakpoints and watchpoints, so that the program runs on without GDB.
  void leave();

  // Each change is repeated when another run passes the position of the change.
  void write(std::size_t number, std::uint64_t value);
  [[nodiscard]] bool writeMemory(std::uint32_t address, std::span<const std::uint8_t> bytes);

  /// @brief Returns the board. The result is valid only during a run.
  [[nodiscard]] const emulator::DebugPort& port() const { return *port_; }

  /// @brief Returns the breakpoints and watchpoints. After a change of a watchpoint, call
  /// rulesChanged().
  [[nodiscard]] StopRules& rules() { return rules_; }
  void rulesChanged();

  /// @brief Returns true if the run has ended.
  [[nodiscard]] bool ended() const { return ended_; }

 private:
  enum class Mode {
    Forward,  ///< runs to the next stop
    Return,   ///< runs to the position target_
    Search,   ///< runs to the position target_, to find the last stop before it
    Time      ///< runs to the time until_
  };

  struct Change {
    std::uint64_t position;
    std::function<void(emulator::DebugPort&)> apply;
  };

  void beforeInstruction();
  void repeatChanges(std::uint64_t position);
  void lookAhead(std::uint64_t position);
  void lookBack(std::uint64_t position);
  void endSearch();
  void stop(const std::string& why);
  [[nodiscard]] bool wantsStop();

  Serve serve_;
  std::function<bool()> asked_;
  emulator::DebugPort* port_ = nullptr;
  StopRules rules_;
  Mode mode_ = Mode::Return;
  std::uint64_t target_ = 0;
  std::string why_ = "05";  ///< reason of the stop at target_
  std::uint64_t from_ = 0;  ///< position of the last stop
  bool steps_ = false;
  std::chrono::nanoseconds until_{};
  std::optional<std::uint64_t> found_;
  std::vector<Change> changes_;
  std::size_t nextChange_ = 0;
  std::uint32_t looks_ = 0;
  bool ended_ = false;
};

}  // namespace wr::gdb
