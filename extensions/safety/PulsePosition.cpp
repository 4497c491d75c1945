#include "safety/PulsePosition.hpp"

namespace wr {

std::optional<std::int32_t> PulsePosition::calculate(const Arguments& arguments) const {
  const std::optional<std::int32_t> width = arguments.value(ArgumentId::Raw);
  const std::optional<std::int32_t> middle = arguments.value(ArgumentId::Offset);
  const std::optional<std::int32_t> lowest = arguments.value(ArgumentId::Lowest);
  const std::optional<std::int32_t> highest = arguments.value(ArgumentId::Highest);
  if (!width || !middle || !lowest || !highest || *width < *lowest || *width > *highest) {
    return std::nullopt;
  }
  return *width - *middle;
}

}  // namespace wr
