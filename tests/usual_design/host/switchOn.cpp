#include <stdexcept>

#include "system/SteppedRobot.hpp"

namespace wr::test {

// The system tests get their robot from this function. The tests of a design must not call it,
// because they construct the robot of this design.
std::unique_ptr<scenario::RobotSession> switchOn() {
  throw std::logic_error("a test of a design constructs its own robot");
}

}  // namespace wr::test
