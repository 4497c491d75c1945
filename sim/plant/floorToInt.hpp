#pragma once

#include <cstdint>

namespace wr::plant {

/// @brief Returns the greatest integer that is not above a number. It is like std::floor, but
/// without a function call.
inline std::int64_t wholePart(double number) {
  const auto towardsZero = static_cast<std::int64_t>(number);
  return static_cast<double>(towardsZero) > number ? towardsZero - 1 : towardsZero;
}

}  // namespace wr::plant
