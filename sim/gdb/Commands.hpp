#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "sim/gdb/Debugger.hpp"
#include "sim/gdb/PacketStream.hpp"

namespace wr::gdb {

/// @brief An exception that is thrown when GDB ends the program.
struct Killed {};

/// @brief The commands of the GDB remote serial protocol, and the commands of `monitor`.
class Commands {
 public:
  /// @param line the serial line to GDB; must outlive the object
  /// @param ends returns true if this process shall end; this function is also called while the
  /// board is stopped
  /// @param goesBack true when the owner of the board can restart the run; otherwise the program
  /// cannot run backwards
  Commands(programs::SerialLine& line, std::function<bool()> ends, bool goesBack = true);

  /// @brief Returns the debugger that executes the commands.
  [[nodiscard]] Debugger& debugger() { return debugger_; }

  /// @brief Checks whether GDB requests a stop. The owner of the board calls this function between
  /// two runs of the board, because the processor may sleep. The function stops the program only if
  /// the program has executed no instruction since the previous call.
  void glance();

 private:
  // The report that GDB expects at the next stop.
  enum class Owed { Nothing, Stop, Monitor };

  void serve(const std::string& why);
  [[nodiscard]] bool obey(std::string_view packet);
  [[nodiscard]] std::string answer(std::string_view packet);
  void resume(std::string_view packet);
  [[nodiscard]] std::string query(std::string_view packet);
  [[nodiscard]] std::string readRegisters() const;
  [[nodiscard]] std::string writeRegisters(std::string_view digits);
  [[nodiscard]] std::string readRegister(std::string_view number) const;
  [[nodiscard]] std::string writeRegister(std::string_view assignment);
  [[nodiscard]] std::string readMemory(std::string_view range) const;
  [[nodiscard]] std::string writeMemory(std::string_view packet);
  [[nodiscard]] std::string setRule(std::string_view packet);
  [[nodiscard]] bool monitor(const std::string& words);
  [[nodiscard]] std::string timeText() const;
  [[nodiscard]] bool asked();

  PacketStream stream_;
  std::function<bool()> ends_;
  bool goesBack_;
  Debugger debugger_;
  Owed owed_ = Owed::Nothing;
  std::string why_;
  std::uint64_t seenPosition_ = 0;
  bool leaves_ = false;
};

}  // namespace wr::gdb
