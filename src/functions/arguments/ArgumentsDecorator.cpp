#include "functions/arguments/ArgumentsDecorator.hpp"

namespace wr {

ArgumentsDecorator::ArgumentsDecorator(const Arguments& wrapped) : wrapped_(wrapped) {}

void ArgumentsDecorator::fill(ArgumentValues& values) const {
  wrapped_.fill(values);
}

}  // namespace wr
