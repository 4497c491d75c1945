#include "functions/SampledAngle.hpp"

#include "functions/scaling.hpp"

namespace wr {

std::optional<std::int32_t> SampledAngle::calculate(const Arguments& arguments) const {
  const std::optional<std::int32_t> sample = arguments.value(ArgumentId::Raw);
  return sample && accepted(arguments, *sample) ? scaled(arguments) : std::nullopt;
}

}  // namespace wr
