// When the system tests are built for the virtual K64, their robot is the firmware image on the
// virtual K64.

#include <chrono>
#include <memory>
#include <stdexcept>

#include "support/image.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {

std::unique_ptr<scenario::RobotSession> switchOn() {
  std::unique_ptr<board_robot::BoardSession> robot = switchBoardOn();
  if (!robot->board.runToSleep(std::chrono::milliseconds(50))) {
    throw std::runtime_error("the firmware does not sleep within 50 ms after its start");
  }
  return robot;
}

int referenceSequences() {
  return 100;
}

}  // namespace wr::test
