#include "sensing/current/ReadCnt.hpp"

namespace wr {

ReadCnt::ReadCnt(AnalogInput& input, ValueCollector& collector)
    : input_(input), collector_(collector) {}

void ReadCnt::execute() {
  const std::optional<std::uint16_t> sample = input_.sample();
  if (sample) {
    collector_.collect(*sample);
  }
}

}  // namespace wr
