#include "remote_control/ReadRcPin.hpp"

namespace wr {

ReadRcPin::ReadRcPin(RcBuffer& buffer, const RcPin& pin, const Timebase& timebase)
    : buffer_(buffer), pin_(pin), timebase_(timebase) {}

void ReadRcPin::execute() {
  buffer_.signal(pin_.level(), timebase_.now());
}

}  // namespace wr
