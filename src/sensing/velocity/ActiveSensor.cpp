#include "sensing/velocity/ActiveSensor.hpp"

namespace wr {

ActiveSensor::ActiveSensor(EdgeInput& a, EdgeInput& b, Command& command)
    : a_(a), b_(b), command_(command) {}

void ActiveSensor::start() {
  command_.execute();
  a_.start();
  b_.start();
}

void ActiveSensor::serve() {
  const bool edgeOfA = a_.acknowledge();
  const bool edgeOfB = b_.acknowledge();
  if (edgeOfA || edgeOfB) {
    // counts: edges
    command_.execute();
  }
}

std::uint8_t ActiveSensor::phase() const {
  const unsigned a = a_.level() ? 1U : 0U;
  const unsigned b = b_.level() ? 2U : 0U;
  return static_cast<std::uint8_t>(a | b);
}

}  // namespace wr
