#pragma once

#include <cstdint>

namespace wr {

/// @brief Number of a condition that must be true. If the condition is false, the program has a
/// fault.
/// @datatype
enum class AssertId : std::uint16_t {
  PartMissing = 1,         ///< a builder needs a part that was not built yet
  PoolFull = 2,            ///< a pool, a stage or a tick got more parts than it can contain
  ThreadStartedTwice = 3,  ///< a control thread received a second command
  FrameTooLarge = 4,       ///< a frame is too large for its buffer
  PartBuiltTwice = 5,      ///< a builder was asked to build a part that it has already built
  TimerFull = 6,           ///< SecondTimer got more commands than it can contain
  InterruptLate = 7,       ///< an interrupt was not served in time
  ProgramChanged = 8       ///< the program in RAM differs from the original in flash
};

/// @brief Ends the program because a condition was false. Each platform defines this function.
/// @param id the condition that was false
[[noreturn]] void assertionFailed(AssertId id);

/// @brief Ends the program when a condition is false. This function is always inlined, because a
/// call would take longer than the check.
/// @param condition the condition that must be true
/// @param id number of the condition
[[gnu::always_inline]] inline void require(bool condition, AssertId id) {
  if (!condition) {
    assertionFailed(id);
  }
}

}  // namespace wr
