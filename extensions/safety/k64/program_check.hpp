#pragma once

#include "safety/ProgramCheck.hpp"

namespace wr::platform {

/// @brief Compares the program in RAM with the program in flash. The handler of the tick and checkForever()
/// call it.
extern ProgramCheck programCheck;

/// @brief Shows that control cycles run, and checks the program between the interrupts.
/// @satisfies FR-309
/// @isr{no}
[[noreturn]] void checkForever();

}  // namespace wr::platform
