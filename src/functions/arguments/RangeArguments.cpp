#include "functions/arguments/RangeArguments.hpp"

namespace wr {

RangeArguments::RangeArguments(const Arguments& wrapped, std::int32_t lowest, std::int32_t highest)
    : ArgumentsDecorator(wrapped), lowest_(lowest), highest_(highest) {}

std::optional<std::int32_t> RangeArguments::value(ArgumentId id) const {
  switch (id) {
    case ArgumentId::Lowest:
      return lowest_;
    case ArgumentId::Highest:
      return highest_;
    default:
      return ArgumentsDecorator::value(id);
  }
}

}  // namespace wr
