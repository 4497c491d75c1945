// For these system tests, the virtual K64 executes the firmware image that uses the CAN bus.

#include <chrono>
#include <memory>
#include <stdexcept>

#include "ports/can/tests/CanSession.hpp"
#include "support/image.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {

std::unique_ptr<scenario::RobotSession> switchOn() {
  auto board = switchBoardOn();
  if (!board->board.runToSleep(std::chrono::milliseconds(50))) {
    throw std::runtime_error("the firmware does not sleep within 50 ms after its start");
  }
  return std::make_unique<can::CanSession>(std::move(board));
}

int referenceSequences() {
  return 100;
}

}  // namespace wr::test
