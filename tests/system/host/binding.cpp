// The robot of the system tests is the firmware on the host.

#include "sim/scenario/HostLine.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {

std::unique_ptr<RobotLine> switchOn() {
  auto line = std::make_unique<HostLine>();
  line->start();
  return line;
}

int referenceSequences() {
  return 200;
}

}  // namespace wr::test
