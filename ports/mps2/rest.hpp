#pragma once

extern "C" {

/// @brief Sleeps until the next interrupt. All interrupts that came before are served when the processor enters it; a
/// debugger that stops here finds the firmware at rest. The label awake
/// is behind the instruction that sleeps.
/// @isr{no}
[[gnu::noinline]] void rest();
}
