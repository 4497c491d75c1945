#include "functions/arguments/ScaleArguments.hpp"

namespace wr {

ScaleArguments::ScaleArguments(const Arguments& wrapped, std::int32_t scale, std::int32_t divisor,
                               std::int32_t offset)
    : ArgumentsDecorator(wrapped), scale_(scale), divisor_(divisor), offset_(offset) {}

void ScaleArguments::fill(ArgumentValues& values) const {
  ArgumentsDecorator::fill(values);
  values.set(ArgumentId::Scale, scale_);
  values.set(ArgumentId::Divisor, divisor_);
  values.set(ArgumentId::Offset, offset_);
}

}  // namespace wr
