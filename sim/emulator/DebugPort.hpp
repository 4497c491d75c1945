#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

namespace wr::emulator {

class CortexM4;

/// @brief The access of a debugger to the processor and its memory. An access takes no simulated
/// time and never causes a finding.
class DebugPort {
 public:
  /// @brief A register that a debugger sees.
  struct Register {
    std::string_view name;  ///< name in GDB
    unsigned bits;          ///< 8, 32 or 64
  };

  /// @brief Access to the peripherals and to the time.
  struct Bus {
    /// Reads 1, 2 or 4 bytes. Returns false if the access is rejected.
    std::function<bool(std::uint32_t address, unsigned size, std::uint32_t& value)> read;
    /// Writes 1, 2 or 4 bytes. Returns false if the access is rejected.
    std::function<bool(std::uint32_t address, unsigned size, std::uint32_t value)> write;
    /// Returns the time since the board was switched on.
    std::function<std::chrono::nanoseconds()> now;
  };

  /// @param cpu the processor
  /// @param bus access to the peripherals
  DebugPort(CortexM4& cpu, Bus bus) : cpu_(cpu), bus_(std::move(bus)) {}

  /// @brief Number of the program counter.
  static constexpr std::size_t kPc = 15;

  /// @brief Returns the registers, in the order of their numbers.
  [[nodiscard]] static std::span<const Register> registers();

  /// @brief Reads a register.
  /// @param number index in registers()
  [[nodiscard]] std::uint64_t read(std::size_t number) const;

  /// @brief Writes a register.
  /// @param number index in registers()
  void write(std::size_t number, std::uint64_t value);

  /// @brief Reads memory and registers of peripherals. Does not read a register if reading it has a
  /// side effect.
  /// @return number of bytes before the first byte that cannot be read
  [[nodiscard]] std::size_t readMemory(std::uint32_t address, std::span<std::uint8_t> bytes) const;

  /// @brief Writes flash, RAM and registers of peripherals, but not registers of system control.
  /// @return true if all bytes were written
  [[nodiscard]] bool writeMemory(std::uint32_t address, std::span<const std::uint8_t> bytes);

  /// @brief Sets the callback that runs before each instruction. The callback may read and write
  /// registers and memory.
  void onInstruction(std::function<void()> call);

  /// @brief Sets the callback that runs after each load and store of the program. An empty function
  /// removes the callback.
  void onAccess(std::function<void(std::uint32_t address, std::uint32_t size, bool store)> call);

  /// @brief Returns the number of instructions since the board was switched on.
  [[nodiscard]] std::uint64_t instructions() const;

  /// @brief Returns the time since the board was switched on.
  [[nodiscard]] std::chrono::nanoseconds now() const { return bus_.now(); }

 private:
  [[nodiscard]] std::optional<std::uint32_t> inspect(std::uint32_t address, unsigned size) const;

  CortexM4& cpu_;
  Bus bus_;
};

}  // namespace wr::emulator
