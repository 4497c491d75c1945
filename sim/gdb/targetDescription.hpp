#pragma once

#include <string>

namespace wr::gdb {

/// @brief Returns the description of the processor for GDB. It contains a Cortex-M4F and its
/// registers, in the order of emulator::DebugPort::registers().
[[nodiscard]] std::string targetDescription();

}  // namespace wr::gdb
