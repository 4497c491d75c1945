#pragma once

#include <cstdint>

namespace wr::emulator {

/// @brief Model of the time of an instruction.
enum class Timing : std::uint8_t {
  NoWaitStates,  ///< the cycles of the processor's manual, with memory without wait states
  SlowFlash      ///< in addition, each read of flash takes kFlashCycles, without cache and prefetch
};

// Cortex-M4 TRM (ARM DDI 0439), table 3-1 (processor) and table 7-1 (floating-point unit). Where
// the manual gives a range, the value here is the upper end. An instruction begins with one cycle;
// these are the additional cycles.

/// @brief P of the manual, 1 to 3: the pipeline is filled again after each branch that is taken.
inline constexpr std::uint32_t kRefillCycles = 3;
/// @brief Load or store of one register; neighbouring accesses do not overlap.
inline constexpr std::uint32_t kAccessCycles = 1;
/// @brief SDIV and UDIV, 2 to 12, depending on the numbers.
inline constexpr std::uint32_t kDivideCycles = 11;
/// @brief CPS, MRS and MSR, 1 or 2.
inline constexpr std::uint32_t kSpecialCycles = 1;
/// @brief B of the manual for ISB; DMB and DSB need no more cycles, because no access is pending.
inline constexpr std::uint32_t kBarrierCycles = kRefillCycles;
/// @brief VDIV and VSQRT.
inline constexpr std::uint32_t kFpDivideCycles = 13;
/// @brief VMLA, VFMA and the like.
inline constexpr std::uint32_t kFpAccumulateCycles = 2;

// Cortex-M4 TRM, 3.9: exceptions.
inline constexpr std::uint32_t kEntryCycles = 12;
inline constexpr std::uint32_t kExitCycles = 10;
inline constexpr std::uint32_t kTailCycles = 6;

// Timing::SlowFlash: a flash of 24 MHz under a core of 120 MHz, read in phrases.
inline constexpr std::uint32_t kFlashCycles = 5;
inline constexpr std::uint32_t kPhrase = 8;

}  // namespace wr::emulator
