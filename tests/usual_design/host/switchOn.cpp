#include <stdexcept>

#include "system/SteppedRobot.hpp"

namespace wr::test {

// These tests make the robot of the design that they test.
std::unique_ptr<scenario::RobotSession> switchOn() {
  throw std::logic_error("a test of a design makes its own robot");
}

}  // namespace wr::test
