#include "functions/arguments/ScaleArguments.hpp"

namespace wr {

ScaleArguments::ScaleArguments(const Arguments& wrapped, std::int32_t scale, std::int32_t divisor,
                               std::int32_t offset)
    : ArgumentsDecorator(wrapped), scale_(scale), divisor_(divisor), offset_(offset) {}

std::optional<std::int32_t> ScaleArguments::value(ArgumentId id) const {
  switch (id) {
    case ArgumentId::Scale:
      return scale_;
    case ArgumentId::Divisor:
      return divisor_;
    case ArgumentId::Offset:
      return offset_;
    default:
      return ArgumentsDecorator::value(id);
  }
}

}  // namespace wr
