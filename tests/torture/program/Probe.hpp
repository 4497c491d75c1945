#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace wr::torture {

/// @brief The values of all registers before and after an action that may cause exceptions. The
/// functions in probe.S use the offsets of the members.
struct Probe {
  std::array<std::uint32_t, 13> core;
  std::uint32_t flags;
  std::uint32_t pad;
  std::uint32_t usesFp;
  std::uint32_t stack;
  std::array<std::uint32_t, 13> coreAfter;
  std::uint32_t flagsAfter;
  std::uint32_t stackBefore;
  std::uint32_t stackAfter;
  std::uint32_t fpStatusAtStart;
  std::uint32_t fpStatus;
  std::uint32_t fpStatusAfter;
  std::array<std::uint32_t, 32> fp;
  std::array<std::uint32_t, 32> fpAfter;
};
static_assert(offsetof(Probe, fpAfter) == 272);

extern "C" {
/// @brief Stores R1 at the address in R0.
void probeStore(Probe& probe);
/// @brief Calls the supervisor.
void probeSupervisor(Probe& probe);
/// @brief Executes an undefined instruction.
void probeUndefined(Probe& probe);
/// @brief Loads R2 from the address in R0. This address has no memory.
void probeBusError(Probe& probe);
/// @brief In an IT block, stores R1 at the address in R0, and copies R3 to R2.
void probeItBlock(Probe& probe);
}

}  // namespace wr::torture
