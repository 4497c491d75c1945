#include "remote_control/RcPin.hpp"

namespace wr {

RcPin::RcPin(EdgeInput& input, Command& command) : input_(input), command_(command) {}

void RcPin::start() {
  input_.start();
}

void RcPin::serve() {
  if (input_.acknowledge()) {
    // counts: edges
    command_.execute();
  }
}

bool RcPin::level() const {
  return input_.level();
}

}  // namespace wr
