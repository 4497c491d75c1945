#include "functions/scaling.hpp"

#include <algorithm>
#include <utility>

namespace wr {

namespace {

// The core divides 32 bits with one instruction, and 64 bits with a loop.
std::int64_t divided(std::int64_t dividend, std::int64_t divisor) {
  if (std::in_range<std::int32_t>(dividend) && std::in_range<std::int32_t>(divisor)) {
    return static_cast<std::int32_t>(dividend) / static_cast<std::int32_t>(divisor);
  }
  return dividend / divisor;
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

bool accepted(const Arguments& arguments, std::int32_t value) {
  return value >= arguments.value(ArgumentId::Lowest).value_or(value) &&
         value <= arguments.value(ArgumentId::Highest).value_or(value);
}

std::optional<std::int32_t> scaled(const Arguments& arguments) {
  const std::optional<std::int32_t> raw = arguments.value(ArgumentId::Raw);
  const std::optional<std::int32_t> offset = arguments.value(ArgumentId::Offset);
  const std::optional<std::int32_t> scale = arguments.value(ArgumentId::Scale);
  const std::optional<std::int32_t> divisor = arguments.value(ArgumentId::Divisor);
  if (!raw || !offset || !scale || !divisor) {
    return std::nullopt;
  }
  return quotient((std::int64_t{*raw} - *offset) * *scale, *divisor);
}

std::optional<std::int32_t> deflected(const Arguments& arguments, std::int32_t middle) {
  const std::optional<std::int32_t> raw = arguments.value(ArgumentId::Raw);
  const std::optional<std::int32_t> offset = arguments.value(ArgumentId::Offset);
  const std::optional<std::int32_t> scale = arguments.value(ArgumentId::Scale);
  const std::optional<std::int32_t> divisor = arguments.value(ArgumentId::Divisor);
  if (!raw || !offset || !scale || !divisor || !accepted(arguments, *raw)) {
    return std::nullopt;
  }
  const std::int64_t distance = std::int64_t{*raw} - *offset;
  if (distance >= -middle && distance <= middle) {
    return 0;
  }
  const std::int64_t full = distance < 0 ? -std::int64_t{*divisor} : *divisor;
  const std::int64_t deflection =
      distance < 0 ? std::max(distance, full) : std::min(distance, full);
  return quotient(deflection * *scale, *divisor);
}

}  // namespace wr
