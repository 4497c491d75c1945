#include "functions/arguments/BaseArguments.hpp"

#include <algorithm>
#include <limits>

namespace wr {

BaseArguments::BaseArguments(std::int32_t raw, Microseconds elapsed)
    : raw_(raw),
      elapsed_(static_cast<std::int32_t>(std::clamp<std::int64_t>(
          elapsed.count(), 0, std::numeric_limits<std::int32_t>::max()))) {}

void BaseArguments::fill(ArgumentValues& values) const {
  values.set(ArgumentId::Raw, raw_);
  values.set(ArgumentId::Elapsed, elapsed_);
}

}  // namespace wr
