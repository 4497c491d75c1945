#pragma once

#include <cstdint>

namespace wr {

/// @brief Number of a condition that must be true. A failed condition is a fault of the program.
/// @datatype
enum class AssertId : std::uint16_t {
  PartMissing = 1,         ///< a part of the requested product was not built
  PoolFull = 2,            ///< a pool got more control systems than it can contain
  ThreadStartedTwice = 3,  ///< a control thread got a second body
  FrameTooLarge = 4,       ///< a frame is too large for its buffer
  PartBuiltTwice = 5,      ///< a part was requested that the builder has already built
  TimerFull = 6,           ///< the second timer got more commands than it can contain
  InterruptLate = 7,       ///< an interrupt was not served in time
  ProgramChanged = 8       ///< the program in RAM differs from its original
};

/// @brief Ends the program because a condition was false. Each platform defines this function.
/// @param id the condition that was false
[[noreturn]] void assertionFailed(AssertId id);

/// @brief Ends the program when a condition is false. Always inlined: a call would cost more than
/// the check.
/// @param condition the condition that must be true
/// @param id number of the condition
[[gnu::always_inline]] inline void require(bool condition, AssertId id) {
  if (!condition) {
    assertionFailed(id);
  }
}

}  // namespace wr
