#include "sensing/current/ReadCnt.hpp"

namespace wr {

ReadCnt::ReadCnt(AnalogInput& input, ValueCollector& collector, const Timebase& timebase)
    : input_(input), collector_(collector), timebase_(timebase) {}

void ReadCnt::execute() {
  const std::optional<std::uint16_t> sample = input_.take();
  if (sample) {
    collector_.collect(*sample, timebase_.now());
  }
  input_.convert();
}

}  // namespace wr
