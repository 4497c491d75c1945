#include "functions/HallVelocity.hpp"

#include "functions/scaling.hpp"

namespace wr {

std::optional<std::int32_t> HallVelocity::calculate(const Arguments& arguments) const {
  const std::optional<std::int32_t> edges = arguments.value(ArgumentId::Raw);
  const std::optional<std::int32_t> elapsed = arguments.value(ArgumentId::Elapsed);
  const std::optional<std::int32_t> scale = arguments.value(ArgumentId::Scale);
  const std::optional<std::int32_t> divisor = arguments.value(ArgumentId::Divisor);
  if (!edges || !elapsed || !scale || !divisor) {
    return std::nullopt;
  }
  const std::optional<std::int32_t> velocity =
      quotient(std::int64_t{*edges} * *scale, std::int64_t{*elapsed} * *divisor);
  return velocity && accepted(arguments, *velocity) ? velocity : std::nullopt;
}

}  // namespace wr
