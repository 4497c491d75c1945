#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "sim/board_robot/BoardSession.hpp"
#include "sim/faults/Random.hpp"

namespace wr::faults {

/// @brief Part of the robot that a fault hits.
enum class Kind : std::uint8_t {
  Ram,        ///< a bit of .data or .bss
  Code,       ///< a bit of the program in RAM
  Stack,      ///< a bit of the stack in use
  Register,   ///< a bit of a core register
  Flash,      ///< a bit of the image
  Interrupt,  ///< an interrupt that is lost, late or raised without cause
  Sensor,     ///< a sensor that is stuck, off or noisy
  Serial,     ///< noise on the line from the PC
  Clock,      ///< another clock of the PC; the external clock or the lock of the PLL is lost
  Supply      ///< low voltage, power cycle, reset pin
};
inline constexpr std::uint32_t kKinds = 10;

/// @brief Returns the name of a kind in the record.
[[nodiscard]] std::string_view nameOf(Kind kind);

/// @brief Returns the kind with a name; nothing if there is none.
[[nodiscard]] std::optional<Kind> kindOf(std::string_view name);

/// @brief Memory of the image that faults can hit.
struct Places {
  std::uint32_t codeBegin;
  std::uint32_t codeEnd;  ///< end of the program in RAM
  std::uint32_t dataBegin;
  std::uint32_t dataEnd;   ///< end of .data and .bss
  std::uint32_t stackEnd;  ///< begin of the stack, which grows downwards
  std::uint32_t flashEnd;
  std::vector<int> interrupts;  ///< lines that the firmware uses
};

/// @brief A fault.
struct Fault {
  Kind kind = Kind::Ram;
  std::uint32_t place = 0;  ///< address, register, line, or number of the fault within its kind
  std::uint32_t bit = 0;    ///< bit of the place, or number of the wheel
  int value = 0;            ///< value of the fault, if it has one
};

/// @brief Returns whether the fault needs an instant at which the processor does not sleep.
[[nodiscard]] inline bool needsAwake(Kind kind) {
  return kind == Kind::Stack || kind == Kind::Register;
}

/// @brief Returns whether memory can have the content of a run without the fault, some time after
/// the fault.
[[nodiscard]] inline bool passes(Kind kind) {
  return kind == Kind::Ram || kind == Kind::Stack || kind == Kind::Register;
}

/// @brief Longest time of observation [ms]. The angle sensor may drift for 6.8 s before FR-227 detects
/// it, and implausible Hall edges reach the count of FR-279 in seconds.
inline constexpr int kLongestWindow = 7000;

/// @brief Returns how long the run with the fault is observed [ms]: at least until the firmware must
/// have reported the fault. A wheel without Hall edges is reported 1 s after it has voltage.
[[nodiscard]] int windowOf(const Fault& fault);

/// @brief Chooses a kind of fault. The most frequent kinds are changed bits of RAM, in objects and
/// in the program.
[[nodiscard]] Kind chooseKind(Random& random);

/// @brief Chooses a fault of a kind.
/// @param kind the kind
/// @param random chooses
/// @param places the memory that can be hit
/// @param stack stack pointer at the instant
[[nodiscard]] Fault choose(Kind kind, Random& random, const Places& places, std::uint32_t stack);

/// @brief Injects a fault now. Noise on the line is not injected here: see noiseOf.
void inject(const Fault& fault, board_robot::BoardSession& robot);

/// @brief Ends a fault that lasts a limited time.
/// @param fault the fault
/// @param ms time since the injection
void endIfDue(const Fault& fault, int ms, board_robot::BoardSession& robot);

/// @brief Returns the number of wrong bits per thousand bits of the line from the PC; 0 without
/// noise.
[[nodiscard]] int noiseOf(const Fault& fault);

}  // namespace wr::faults
