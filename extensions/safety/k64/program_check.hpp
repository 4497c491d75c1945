#pragma once

namespace wr::platform {

/// @brief Shows that control cycles run, and checks the program between the interrupts.
/// @satisfies FR-309
/// @isr{no}
[[noreturn]] void checkForever();

}  // namespace wr::platform
