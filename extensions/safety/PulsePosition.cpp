#include "safety/PulsePosition.hpp"

namespace wr {

std::optional<std::int32_t> PulsePosition::calculate(const Arguments& arguments) const {
  ArgumentValues values;
  arguments.fill(values);
  if (!values.has(ArgumentId::Raw, ArgumentId::Offset)) {
    return std::nullopt;
  }
  return values[ArgumentId::Raw] - values[ArgumentId::Offset];
}

}  // namespace wr
