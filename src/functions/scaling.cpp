#include "functions/scaling.hpp"

#include <algorithm>
#include <utility>

namespace wr {

namespace {

// Returns dividend / divisor. If both numbers have 32 bits, the processor divides them with one
// instruction. A division of 64 bits needs a loop.
std::int64_t divided(std::int64_t dividend, std::int64_t divisor) {
  if (std::in_range<std::int32_t>(dividend) && std::in_range<std::int32_t>(divisor)) {
    return static_cast<std::int32_t>(dividend) / static_cast<std::int32_t>(divisor);
  }
  return dividend / divisor;
}

bool hasScaledRaw(const ArgumentValues& values) {
  return values.has(ArgumentId::Raw, ArgumentId::Offset, ArgumentId::Scale, ArgumentId::Divisor);
}

// Returns Raw - Offset.
std::int64_t distance(const ArgumentValues& values) {
  return std::int64_t{values[ArgumentId::Raw]} - values[ArgumentId::Offset];
}

}  // namespace

std::optional<std::int32_t> quotient(std::int64_t dividend, std::int64_t divisor) {
  if (divisor <= 0) {
    return std::nullopt;
  }
  const std::int64_t half = dividend < 0 ? -(divisor / 2) : divisor / 2;
  const std::int64_t result = divided(dividend + half, divisor);
  if (!std::in_range<std::int32_t>(result)) {
    return std::nullopt;
  }
  return static_cast<std::int32_t>(result);
}

bool accepted(const ArgumentValues& values, std::int32_t value) {
  return value >= values[ArgumentId::Lowest] && value <= values[ArgumentId::Highest];
}

std::optional<std::int32_t> scaled(const ArgumentValues& values) {
  if (!hasScaledRaw(values)) {
    return std::nullopt;
  }
  return quotient(distance(values) * values[ArgumentId::Scale], values[ArgumentId::Divisor]);
}

std::optional<std::int32_t> deflected(const ArgumentValues& values, std::int32_t middle) {
  if (!hasScaledRaw(values) || !accepted(values, values[ArgumentId::Raw])) {
    return std::nullopt;
  }
  const std::int64_t deflection = distance(values);
  if (deflection >= -middle && deflection <= middle) {
    return 0;
  }
  const std::int32_t divisor = values[ArgumentId::Divisor];
  const std::int64_t full = deflection < 0 ? -std::int64_t{divisor} : divisor;
  const std::int64_t limited =
      deflection < 0 ? std::max(deflection, full) : std::min(deflection, full);
  return quotient(limited * values[ArgumentId::Scale], divisor);
}

}  // namespace wr
