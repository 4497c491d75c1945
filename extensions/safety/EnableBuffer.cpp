#include "safety/EnableBuffer.hpp"

namespace wr {

namespace {

constexpr std::int32_t kMiddle = 1500;         // [us]
constexpr std::int32_t kFullDeflection = 500;  // [us]: the deflection is in us

}  // namespace

EnableBuffer::EnableBuffer(InstantCollector& instants, const Function& function,
                           Pipe<Microseconds>& width)
    : RcBuffer(instants, function), pipe_(width) {}

std::int32_t EnableBuffer::fullDeflection() const {
  return kFullDeflection;
}

void EnableBuffer::keep(std::int32_t value, Instant at) {
  pipe_.write(Microseconds(kMiddle + value), at);
}

}  // namespace wr
