#include <stdexcept>

#include "system/SteppedRobot.hpp"

namespace wr::test {

// The system tests get their robot from this function. The tests of a design must not call this
// function, because each of these tests constructs a robot with its own design.
std::unique_ptr<scenario::RobotSession> switchOn() {
  throw std::logic_error("a test of a design constructs its own robot");
}

}  // namespace wr::test
