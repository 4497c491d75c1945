#include "remote_control/RcPin.hpp"

namespace wr {

RcPin::RcPin(EdgeInput& input, Command& command) : input_(input), command_(command) {}

void RcPin::start() {
  input_.start();
}

void RcPin::serve() {
  if (input_.acknowledge()) {
    // passes: 1; further edges that one interrupt serves count as separate interrupts
    command_.execute();
  }
}

bool RcPin::level() const {
  return input_.level();
}

}  // namespace wr
