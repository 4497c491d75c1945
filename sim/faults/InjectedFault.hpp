#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "sim/board_robot/BoardSession.hpp"
#include "sim/faults/Random.hpp"

namespace wr::faults {

/// @brief Kind of a fault.
enum class Kind : std::uint8_t {
  Ram,        ///< a changed bit of an object or a constant in RAM (.data or .bss)
  Code,       ///< a changed bit of the program in RAM
  Stack,      ///< a changed bit of the stack in use
  Register,   ///< a changed bit of a core register
  Flash,      ///< a changed bit of the firmware image in flash
  Interrupt,  ///< an interrupt that is lost, late, or raised without a cause
  Sensor,     ///< a sensor that is stuck, inaccurate or noisy
  Serial,     ///< noise on the serial line from the PC
  Clock,      ///< a wrong baud rate of the PC, or the loss of the external clock or of the PLL lock
  Supply      ///< a reset with the cause low voltage, power-on or pin
};
inline constexpr std::uint32_t kKinds = 10;

/// @brief Returns the name of a kind, as in the record of the fault campaign.
[[nodiscard]] std::string_view nameOf(Kind kind);

/// @brief Returns the kind with the given name; nothing if there is no such kind.
[[nodiscard]] std::optional<Kind> kindOf(std::string_view name);

/// @brief The memory and the interrupts that faults can affect.
struct Places {
  std::uint32_t codeBegin;
  std::uint32_t codeEnd;  ///< end of the program in RAM
  std::uint32_t dataBegin;
  std::uint32_t dataEnd;   ///< end of .data and .bss
  std::uint32_t stackEnd;  ///< start of the stack, which grows downwards
  std::uint32_t flashEnd;
  std::vector<int> interrupts;  ///< interrupt lines that the firmware uses
};

/// @brief A fault to inject.
struct InjectedFault {
  Kind kind = Kind::Ram;
  std::uint32_t place =
      0;  ///< memory address, register, interrupt line, or number of the fault within its kind
  std::uint32_t bit = 0;  ///< number of the bit or of the wheel, or kind of the interrupt fault
  int value = 0;          ///< value of the fault, if its kind has a value
};

/// @brief Returns true if a fault of this kind can be injected only while the processor is awake.
[[nodiscard]] inline bool needsAwake(Kind kind) {
  return kind == Kind::Stack || kind == Kind::Register;
}

/// @brief Returns true if the effect of a fault of this kind can disappear. When the effect has
/// disappeared, the memory has the same content as in a run without the fault.
[[nodiscard]] inline bool passes(Kind kind) {
  return kind == Kind::Ram || kind == Kind::Stack || kind == Kind::Register;
}

/// @brief Longest time of observation [ms]. If the angle sensor drifts by 0.5 degrees per second,
/// the firmware detects the drift within 6.9 s (FR-227). A slower drift may be detected after the
/// observation. If Hall edges are lost, the number of implausible edges reaches the limit of FR-279
/// only after some seconds.
inline constexpr int kLongestWindow = 7000;

/// @brief Returns the duration of the observation after the fault [ms]. The firmware must report
/// each fault before a certain time, and the observation does not end before this time. The only
/// exception is a slow drift of the angle sensor. Example: a wheel has voltage, but no Hall edges.
/// The firmware reports this fault after 1 s.
[[nodiscard]] int windowOf(const InjectedFault& fault);

/// @brief Chooses a kind of fault. The two most frequent kinds change a bit in RAM: a bit of an
/// object, or a bit of the program.
[[nodiscard]] Kind chooseKind(Random& random);

/// @brief Chooses a fault of a kind.
/// @param kind the kind
/// @param random source of the random choice
/// @param places the memory and the interrupts that can be affected
/// @param stack stack pointer at the time of the injection
[[nodiscard]] InjectedFault choose(Kind kind, Random& random, const Places& places,
                                   std::uint32_t stack);

/// @brief Injects a fault now. This function does not inject noise on the serial line. For noise,
/// see noiseOf().
void inject(const InjectedFault& fault, board_robot::BoardSession& robot);

/// @brief Unblocks the interrupt line that the fault blocks, if the duration of the fault has just
/// passed. For a fault of another kind, does nothing.
/// @param fault the fault
/// @param ms time since the injection
void endIfDue(const InjectedFault& fault, int ms, board_robot::BoardSession& robot);

/// @brief Returns the number of wrong bits per 1000 bits on the serial line from the PC; 0 for a
/// fault without noise.
[[nodiscard]] int noiseOf(const InjectedFault& fault);

}  // namespace wr::faults
