#include "functions/arguments/BaseArguments.hpp"

#include <algorithm>
#include <limits>

namespace wr {

BaseArguments::BaseArguments(std::int32_t raw, Microseconds elapsed)
    : raw_(raw),
      elapsed_(static_cast<std::int32_t>(std::clamp<std::int64_t>(
          elapsed.count(), 0, std::numeric_limits<std::int32_t>::max()))) {}

std::optional<std::int32_t> BaseArguments::value(ArgumentId id) const {
  switch (id) {
    case ArgumentId::Raw:
      return raw_;
    case ArgumentId::Elapsed:
      return elapsed_;
    default:
      return std::nullopt;
  }
}

}  // namespace wr
