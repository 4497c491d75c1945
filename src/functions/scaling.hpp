#pragma once

#include <cstdint>
#include <optional>

#include "functions/arguments/Arguments.hpp"

namespace wr {

/// @brief Divides, and rounds to the nearest number; a half is rounded away from zero.
/// @param dividend number to divide; with a divisor of 32 bits it may be a product of 33 and 32
/// bits
/// @param divisor the divisor
/// @return the quotient; nothing when the divisor is 0 or less, or when the quotient needs more
/// than 32 bits
[[nodiscard]] std::optional<std::int32_t> quotient(std::int64_t dividend, std::int64_t divisor);

/// @brief Returns whether a value is in the range that the values define. A missing bound does
/// not limit the value.
/// @param values contain Lowest and Highest
/// @param value the value
/// @return true when it is in the range
[[nodiscard]] bool accepted(const ArgumentValues& values, std::int32_t value);

/// @brief Calculates (Raw - Offset) * Scale / Divisor.
/// @param values contain the four values
/// @return the result, rounded to the nearest number; nothing when a value is missing
[[nodiscard]] std::optional<std::int32_t> scaled(const ArgumentValues& values);

/// @brief Calculates the value of a lever of the remote control: (Raw - Offset) * Scale / Divisor,
/// where Raw - Offset is limited to Divisor on either side.
/// @param values contain the four values, and the range of Raw
/// @param middle up to this distance of Raw from Offset the result is 0
/// @return the result, rounded to the nearest number; nothing when a value is missing or Raw is out
/// of its range
[[nodiscard]] std::optional<std::int32_t> deflected(const ArgumentValues& values,
                                                    std::int32_t middle);

}  // namespace wr
