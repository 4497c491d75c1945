#pragma once

#include <cerrno>
#include <string>
#include <system_error>

namespace wr::programs {

/// @brief Returns the result of a system call. Throws std::system_error when the result is
/// negative.
/// @param result the result
/// @param name name of the system call for the error message
inline int checked(int result, const std::string& name) {
  if (result < 0) {
    throw std::system_error(errno, std::generic_category(), name);
  }
  return result;
}

}  // namespace wr::programs
