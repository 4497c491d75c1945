#pragma once

#include "torture/Image.hpp"

namespace wr::torture {

/// @brief QEMU's Cortex-M4, as a machine that has memory at 0 and at 0x20000000.
class Qemu {
 public:
  /// @brief Returns whether QEMU is installed.
  [[nodiscard]] static bool installed();

  /// @brief Runs a program to its end.
  /// @return its records
  /// @throws std::runtime_error when the program does not end in a minute
  [[nodiscard]] static Records run(const Image& image);
};

}  // namespace wr::torture
