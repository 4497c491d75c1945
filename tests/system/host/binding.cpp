// When the system tests are built for the host, their robot is the firmware on the host.

#include "sim/host_robot/HostSession.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {

std::unique_ptr<scenario::RobotSession> switchOn() {
  auto line = std::make_unique<host_robot::HostSession>();
  line->start();
  return line;
}

int referenceSequences() {
  return 100;
}

}  // namespace wr::test
