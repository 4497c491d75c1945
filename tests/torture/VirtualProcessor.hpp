#pragma once

#include "torture/Image.hpp"

namespace wr::torture {

/// @brief The processor of the virtual K64, with the memory that the torture program needs.
class VirtualProcessor {
 public:
  /// @brief Runs a program to its end.
  /// @return the records of the program
  /// @throws std::runtime_error when the program does not end, or stops the processor
  [[nodiscard]] static Records run(const Image& image);
};

}  // namespace wr::torture
