#pragma once

#include <cstdint>

namespace wr {

/// @brief Number of a condition that must hold. A failed condition is a fault of the program.
/// @datatype
enum class AssertId : std::uint16_t {
  PartMissing = 1,         ///< a builder was asked for a product that lacks a part
  PoolFull = 2,            ///< a control system pool was given more systems than it can hold
  ThreadStartedTwice = 3,  ///< a control thread was given a second body
  FrameTooLarge = 4,       ///< a frame was to be encoded that does not fit in its storage
  PartBuiltTwice = 5,      ///< a builder was asked for a part that it has made
  TimerFull = 6,           ///< the second timer was given more commands than it can hold
  InterruptLate = 7,       ///< an interrupt was not served in time
  ProgramChanged = 8       ///< the program in RAM differs from its original
};

/// @brief Ends the program because a condition did not hold. Each platform defines it.
/// @param id the condition that did not hold
[[noreturn]] void assertionFailed(AssertId id);

/// @brief Ends the program when a condition does not hold. Always inlined: a call would cost more.
/// @param condition the condition that must be true
/// @param id number of the condition
[[gnu::always_inline]] inline void require(bool condition, AssertId id) {
  if (!condition) {
    assertionFailed(id);
  }
}

}  // namespace wr
