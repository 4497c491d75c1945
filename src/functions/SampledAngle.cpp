#include "functions/SampledAngle.hpp"

#include "functions/scaling.hpp"

namespace wr {

std::optional<std::int32_t> SampledAngle::calculate(const Arguments& arguments) const {
  ArgumentValues values;
  arguments.fill(values);
  return scaled(values);
}

}  // namespace wr
