#include "remote_control/VelocityBuffer.hpp"

#include "services/SystemConstants.hpp"

namespace wr {

VelocityBuffer::VelocityBuffer(InstantCollector& instants, const Function& function,
                               Pipe<Velocity>& velocity)
    : RcBuffer(instants, function), pipe_(velocity) {}

std::int32_t VelocityBuffer::fullDeflection() const {
  return SystemConstants::instance().velocityLimit().count();
}

void VelocityBuffer::keep(std::int32_t value, Instant at) {
  pipe_.write(Velocity(value), at);
}

}  // namespace wr
