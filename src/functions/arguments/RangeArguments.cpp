#include "functions/arguments/RangeArguments.hpp"

namespace wr {

RangeArguments::RangeArguments(const Arguments& wrapped, std::int32_t lowest, std::int32_t highest)
    : ArgumentsDecorator(wrapped), lowest_(lowest), highest_(highest) {}

void RangeArguments::fill(ArgumentValues& values) const {
  ArgumentsDecorator::fill(values);
  values.set(ArgumentId::Lowest, lowest_);
  values.set(ArgumentId::Highest, highest_);
}

}  // namespace wr
