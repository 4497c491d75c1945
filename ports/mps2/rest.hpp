#pragma once

extern "C" {

/// @brief Sleeps until the next interrupt. When the processor sleeps, it has served all earlier
/// interrupts; a debugger that stops here finds the firmware at rest. The label `awake` follows the
/// instruction that sleeps.
/// @isr{no}
[[gnu::noinline]] void rest();
}
