#pragma once

#include "safety/ProgramCheck.hpp"

namespace wr::platform {

/// @brief The check that compares the program in RAM with the program in flash. The handler of each
/// tick permits one step, and checkForever() executes the step.
extern ProgramCheck programCheck;

/// @brief Switches on the light that shows the end of the start. Then checks the program in RAM
/// while no interrupt is active. Never returns.
/// @isr{no}
[[noreturn]] void checkForever();

}  // namespace wr::platform
