#include "functions/SampledCurrent.hpp"

#include "functions/scaling.hpp"

namespace wr {

std::optional<std::int32_t> SampledCurrent::calculate(const Arguments& arguments) const {
  ArgumentValues values;
  arguments.fill(values);
  const std::optional<std::int32_t> current = scaled(values);
  return current && accepted(values, *current) ? current : std::nullopt;
}

}  // namespace wr
