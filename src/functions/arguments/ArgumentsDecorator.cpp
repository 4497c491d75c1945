#include "functions/arguments/ArgumentsDecorator.hpp"

namespace wr {

ArgumentsDecorator::ArgumentsDecorator(const Arguments& wrapped) : wrapped_(wrapped) {}

std::optional<std::int32_t> ArgumentsDecorator::value(ArgumentId id) const {
  return wrapped_.value(id);
}

}  // namespace wr
