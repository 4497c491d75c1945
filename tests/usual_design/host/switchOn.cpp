#include <stdexcept>

#include "system/SteppedRobot.hpp"

namespace wr::test {

// These tests construct the robot of the tested design.
std::unique_ptr<scenario::RobotSession> switchOn() {
  throw std::logic_error("a test of a design constructs its own robot");
}

}  // namespace wr::test
