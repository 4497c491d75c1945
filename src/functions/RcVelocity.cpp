#include "functions/RcVelocity.hpp"

#include "functions/scaling.hpp"

namespace wr {

namespace {

constexpr std::int32_t kMiddleHalfWidth = 20;  // distance from the middle with velocity 0 [us]

}  // namespace

std::optional<std::int32_t> RcVelocity::calculate(const Arguments& arguments) const {
  ArgumentValues values;
  arguments.fill(values);
  return deflected(values, kMiddleHalfWidth);
}

}  // namespace wr
