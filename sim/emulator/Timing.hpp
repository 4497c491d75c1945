#pragma once

#include <cstdint>

namespace wr::emulator {

/// @brief Model of the duration of an instruction.
enum class Timing : std::uint8_t {
  NoWaitStates,  ///< the cycles of the processor's manual; the memory has no wait states
  SlowFlash      ///< the same cycles, and kFlashCycles more for each read from flash; there is no
                 ///< cache and no prefetch
};

// Each instruction takes at least one cycle. The following constants are the additional cycles of
// some instructions. They are from the Cortex-M4 TRM (ARM DDI 0439), table 3-1 (processor) and
// table 7-1 (floating-point unit). If the manual contains a range, the constant is the upper end of
// the range.

/// @brief Additional cycles of each branch that is taken, because the pipeline is refilled after
/// the branch. The manual calls this number P. Its range is 1 to 3.
inline constexpr std::uint32_t kRefillCycles = 3;
/// @brief Load or store of one register. In this model, successive accesses do not overlap.
inline constexpr std::uint32_t kAccessCycles = 1;
/// @brief SDIV and UDIV. They take 2 to 12 cycles, depending on the operands.
inline constexpr std::uint32_t kDivideCycles = 11;
/// @brief CPS, MRS and MSR. They take 1 or 2 cycles.
inline constexpr std::uint32_t kSpecialCycles = 1;
/// @brief Additional cycles of ISB. The manual calls this number B. DMB and DSB need no additional
/// cycles, because no access is pending.
inline constexpr std::uint32_t kBarrierCycles = kRefillCycles;
/// @brief VDIV and VSQRT.
inline constexpr std::uint32_t kFpDivideCycles = 13;
/// @brief VMLA, VFMA and similar instructions.
inline constexpr std::uint32_t kFpAccumulateCycles = 2;

// Cortex-M4 TRM, 3.9: exceptions.
inline constexpr std::uint32_t kEntryCycles = 12;
inline constexpr std::uint32_t kExitCycles = 10;
inline constexpr std::uint32_t kTailCycles = 6;

// Timing::SlowFlash models a flash of 24 MHz at a core clock of 120 MHz. Each read from flash
// returns a phrase of kPhrase bytes. An instruction in the phrase of the previous fetch needs no
// new read.
inline constexpr std::uint32_t kFlashCycles = 5;
inline constexpr std::uint32_t kPhrase = 8;

}  // namespace wr::emulator
