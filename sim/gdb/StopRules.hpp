#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace wr::gdb {

/// @brief Kinds of access at which a watchpoint stops the program.
enum class Watch { Write, Read, Access };

/// @brief The breakpoints and watchpoints.
class StopRules {
 public:
  /// @brief Sets a breakpoint. Setting the same breakpoint again has no effect.
  void addBreakpoint(std::uint32_t address) { breakpoints_.insert(address); }
  void removeBreakpoint(std::uint32_t address) { breakpoints_.erase(address); }

  /// @brief Returns true if there is a breakpoint at the address of an instruction. The program
  /// then stops before this instruction.
  [[nodiscard]] bool stopsAt(std::uint32_t address) const { return breakpoints_.contains(address); }

  /// @brief Sets a watchpoint.
  /// @param kind accesses at which the program stops
  /// @param address first byte
  /// @param size number of bytes
  void addWatchpoint(Watch kind, std::uint32_t address, std::uint32_t size);
  void removeWatchpoint(Watch kind, std::uint32_t address, std::uint32_t size);
  [[nodiscard]] bool watches() const { return !watchpoints_.empty(); }

  /// @brief Records an access of the program.
  void accessed(std::uint32_t address, std::uint32_t size, bool store);

  /// @brief Returns the watchpoint that an access has triggered since the last call, in the form of
  /// a stop reply, e.g. `watch:20000004;`.
  [[nodiscard]] std::optional<std::string> takeHit();

  /// @brief Removes all breakpoints and watchpoints.
  void clear();

 private:
  struct Watchpoint {
    Watch kind;
    std::uint32_t address;
    std::uint32_t size;
    bool operator==(const Watchpoint&) const = default;
  };

  std::set<std::uint32_t> breakpoints_;
  std::vector<Watchpoint> watchpoints_;
  std::optional<std::string> hit_;
};

}  // namespace wr::gdb
