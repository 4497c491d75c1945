// For these system tests, the board MPS2 executes the firmware. QEMU emulates this board.

#include <memory>
#include <stdexcept>

#include "ports/mps2/tests/QemuSession.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {

std::unique_ptr<scenario::RobotSession> switchOn() {
  return std::make_unique<mps2::QemuSession>(WR_PORT_IMAGE);
}

int referenceSequences() {
  return 40;
}

}  // namespace wr::test
