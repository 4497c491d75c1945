#include "functions/HallVelocity.hpp"

#include "functions/scaling.hpp"

namespace wr {

std::optional<std::int32_t> HallVelocity::calculate(const Arguments& arguments) const {
  ArgumentValues values;
  arguments.fill(values);
  if (!values.has(ArgumentId::Raw, ArgumentId::Elapsed, ArgumentId::Scale, ArgumentId::Divisor)) {
    return std::nullopt;
  }
  const std::optional<std::int32_t> velocity =
      quotient(std::int64_t{values[ArgumentId::Raw]} * values[ArgumentId::Scale],
               std::int64_t{values[ArgumentId::Elapsed]} * values[ArgumentId::Divisor]);
  return velocity && accepted(values, *velocity) ? velocity : std::nullopt;
}

}  // namespace wr
