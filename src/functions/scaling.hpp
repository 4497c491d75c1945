#pragma once

#include <cstdint>
#include <optional>

#include "functions/arguments/Arguments.hpp"

namespace wr {

/// @brief Divides, and rounds the quotient to the nearest integer. A quotient in the middle between
/// two integers is rounded away from zero.
/// @param dividend number to divide; if the divisor fits into 32 bits, the dividend may be each
/// product of a 33-bit number and a 32-bit number
/// @param divisor the divisor
/// @return the quotient; nothing when the divisor is 0 or less, or when the quotient needs more
/// than 32 bits
[[nodiscard]] std::optional<std::int32_t> quotient(std::int64_t dividend, std::int64_t divisor);

/// @brief Returns whether a value is in the range from Lowest to Highest. A missing limit does not
/// restrict the value.
/// @param values arguments of the calculation, with Lowest and Highest
/// @param value the value to check
/// @return true when the value is in the range
[[nodiscard]] bool accepted(const ArgumentValues& values, std::int32_t value);

/// @brief Calculates (Raw - Offset) * Scale / Divisor.
/// @param values arguments of the calculation, with Raw, Offset, Scale and Divisor
/// @return the result, rounded to the nearest integer; nothing when Raw, Offset, Scale or Divisor
/// is missing, or when quotient() returns nothing
[[nodiscard]] std::optional<std::int32_t> scaled(const ArgumentValues& values);

/// @brief Calculates the value of a stick of the remote control: (Raw - Offset) * Scale / Divisor.
/// Before the multiplication, Raw - Offset is limited to the range from -Divisor to Divisor.
/// @param values arguments of the calculation, with Raw, Offset, Scale and Divisor, and with the
/// limits of Raw as Lowest and Highest
/// @param middle greatest distance between Raw and Offset at which the result is 0
/// @return the result, rounded to the nearest integer; nothing when Raw, Offset, Scale or Divisor
/// is missing, when Raw is outside its limits, or when quotient() returns nothing
[[nodiscard]] std::optional<std::int32_t> deflected(const ArgumentValues& values,
                                                    std::int32_t middle);

}  // namespace wr
