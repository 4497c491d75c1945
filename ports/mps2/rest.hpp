#pragma once

extern "C" {

/// @brief Sleeps until the next interrupt. When the processor sleeps, it has served all earlier
/// interrupts. Therefore the firmware is at rest when a debugger stops the processor in this
/// function. The label `awake` marks the first instruction after the sleep.
/// @isr{no}
[[gnu::noinline]] void rest();
}
