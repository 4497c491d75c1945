#include "safety/PulsePosition.hpp"

namespace wr {

std::optional<std::int32_t> PulsePosition::calculate(const Arguments& arguments) const {
  const std::optional<std::int32_t> width = arguments.value(ArgumentId::Raw);
  const std::optional<std::int32_t> middle = arguments.value(ArgumentId::Offset);
  if (!width || !middle) {
    return std::nullopt;
  }
  return *width - *middle;
}

}  // namespace wr
