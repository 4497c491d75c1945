#include "functions/SampledCurrent.hpp"

#include "functions/scaling.hpp"

namespace wr {

std::optional<std::int32_t> SampledCurrent::calculate(const Arguments& arguments) const {
  const std::optional<std::int32_t> current = scaled(arguments);
  return current && accepted(arguments, *current) ? current : std::nullopt;
}

}  // namespace wr
