#pragma once

#include "torture/Image.hpp"

namespace wr::torture {

/// @brief The Cortex-M4 of QEMU, in a simulated board with memory at the addresses 0 and
/// 0x20000000.
class Qemu {
 public:
  /// @brief Returns true if QEMU is installed.
  [[nodiscard]] static bool installed();

  /// @brief Runs a program to its end.
  /// @return the records of the program
  /// @throws std::runtime_error when the program does not end within a minute
  [[nodiscard]] static Records run(const Image& image);
};

}  // namespace wr::torture
