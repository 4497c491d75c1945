#include "safety/PulsePosition.hpp"

#include "functions/scaling.hpp"

namespace wr {

std::optional<std::int32_t> PulsePosition::calculate(const Arguments& arguments) const {
  return deflected(arguments, 0);
}

}  // namespace wr
