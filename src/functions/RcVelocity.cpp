#include "functions/RcVelocity.hpp"

#include "functions/scaling.hpp"

namespace wr {

namespace {

constexpr std::int32_t kMiddleHalfWidth = 20;  // half-width [us] of the range with velocity 0

}  // namespace

std::optional<std::int32_t> RcVelocity::calculate(const Arguments& arguments) const {
  ArgumentValues values;
  arguments.fill(values);
  return deflected(values, kMiddleHalfWidth);
}

}  // namespace wr
