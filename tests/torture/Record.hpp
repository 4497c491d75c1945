#pragma once

#include <array>
#include <cstdint>

namespace wr::torture {

/// @brief Kind of a record of the torture program.
enum class Kind : std::uint8_t {
  Entered,      ///< an exception was entered
  Left,         ///< an exception is about to be left
  Acted,        ///< an action and all exceptions that it caused have ended
  Fault,        ///< status registers of a fault: configurable fault, hard fault and address
  CheckFailed,  ///< a check has failed; the record has the checked item, the expected value and the
                ///< actual value
  FpMode        ///< modes in FPSCR at the first use of the floating-point registers
};

/// @brief Actions of the program. In a record of the kind Acted, `detail` is one of these actions.
enum class Action : std::uint8_t {
  PendLines,
  PendSystem,
  PendByNumber,
  ClearPending,
  CallSupervisor,
  UndefinedInstruction,
  BusError,
  PendInItBlock,
  SetPriority,
  SetSystemPriority,
  SetPriorities,
  EnableLines,
  DisableLines,
  EnableFaults,
  SetGrouping,
  RaiseBasePriority,
  MaskInterrupts,
  MaskFaults,
  ForgetFloatingPoint,
  WaitForInterrupt,
  End
};

/// @brief Checked items. In a record of the kind CheckFailed, `detail` is the number of the item.
/// Numbers 0 to 12 are the core registers. Numbers 32 to 63 are the floating-point registers.
enum class Check : std::uint8_t { Flags = 16, StackPointer = 17, FpStatus = 18, LogFull = 19 };

/// @brief An event in the form in which the program writes it.
struct Record {
  Kind kind;
  std::uint8_t detail;  ///< exception, action or check
  std::uint8_t depth;   ///< number of exceptions that are active
  std::uint8_t link;    ///< low byte of EXC_RETURN of the running exception
  std::array<std::uint32_t, 5>
      words;  ///< state of the processor or other numbers, depending on the kind

  friend bool operator==(const Record&, const Record&) = default;
};
static_assert(sizeof(Record) == 24);

/// @brief Addresses in the program at which the test stores the seed and the number of actions.
inline constexpr std::uint32_t kSeedAddress = 0xC0;
inline constexpr std::uint32_t kActionsAddress = 0xC4;

/// @brief Memory of the program. The vectors and the code are at address 0.
inline constexpr std::uint32_t kCodeSize = 0x10000;
inline constexpr std::uint32_t kRamStart = 0x20000000;
inline constexpr std::uint32_t kRamSize = 0x80000;

/// @brief An address without memory.
inline constexpr std::uint32_t kNoMemory = 0x60000000;

}  // namespace wr::torture
