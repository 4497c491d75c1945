#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

struct uc_struct;

namespace wr::emulator::reference {

/// @brief Inputs and results of an instruction.
struct State {
  std::array<std::uint32_t, 15> core{};  ///< registers 0 to 14
  std::uint32_t pc = 0;
  std::uint32_t flags = 0;  ///< N, Z, C, V, Q and GE, as in APSR
  std::array<std::uint32_t, 32> single{};
  std::uint32_t fpscr = 0;

  friend bool operator==(const State&, const State&) = default;
};

inline constexpr std::uint32_t kCode = 0x1000;
inline constexpr std::uint32_t kCodeSize = 0x1000;
inline constexpr std::uint32_t kRam = 0x20000000;
inline constexpr std::uint32_t kRamSize = 0x2000;

/// @brief The Cortex-M4 of the Unicorn engine. The engine is an independent emulator. The tests
/// compare its results with the results of the virtual K64. The licence of Unicorn is the GPL.
/// Therefore Unicorn is linked only to these tests.
class UnicornCore {
 public:
  UnicornCore();
  ~UnicornCore();
  UnicornCore(const UnicornCore&) = delete;
  UnicornCore& operator=(const UnicornCore&) = delete;

  /// @brief Executes the given code, from its start to its end.
  /// @param code one instruction, or IT and one instruction
  /// @param state state before the instruction; receives the state after the instruction
  /// @return false when the instruction is undefined or causes a fault
  bool execute(std::span<const std::uint8_t> code, State& state);

  /// @brief Returns the memory that instructions read and write.
  [[nodiscard]] std::span<std::uint8_t> ram() { return ram_; }

 private:
  uc_struct* engine_ = nullptr;
  std::vector<std::uint8_t> ram_ = std::vector<std::uint8_t>(kRamSize);
  bool faulted_ = false;
};

}  // namespace wr::emulator::reference
