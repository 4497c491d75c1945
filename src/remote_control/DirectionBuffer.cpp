#include "remote_control/DirectionBuffer.hpp"

#include "services/SystemConstants.hpp"

namespace wr {

DirectionBuffer::DirectionBuffer(InstantCollector& instants, const Function& function,
                                 Pipe<Angle>& direction)
    : RcBuffer(instants, function), pipe_(direction) {}

std::int32_t DirectionBuffer::fullDeflection() const {
  return SystemConstants::instance().steeringLimit().count();
}

void DirectionBuffer::keep(std::int32_t value, Instant at) {
  pipe_.write(Angle(value), at);
}

}  // namespace wr
