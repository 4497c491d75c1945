#include "system/OperationStatesReference.hpp"
#include "system/host/HostSteppedRobot.hpp"

namespace wr::test {
namespace {

// The comparison of the robot with the reference. The sources of orders are the PC and a remote
// control. This comparison also includes values that no report contains.
class ComparisonInside final : public Comparison {
 public:
  ComparisonInside(HostSteppedRobot& robot, std::mt19937& random)
      : Comparison(robot, random), robot_(robot) {}

 private:
  void beginSequence() override { rc_ = Runs(oneIn(2), 5, 12); }

  void beforeCycle() override {
    if (!rc_.next(random())) {
      return;
    }
    robot_.wait(microseconds(number(1, kPeriod - 1)));
    const std::int64_t now = lastPulse() + kPeriod - robot_.untilPulse().count();
    if (!oneIn(8)) {
      robot_.robot.rcVelocity(Velocity(number(-3000, 3000)));
      reference().velocityAt = now;
    }
    if (!oneIn(8)) {
      robot_.robot.rcDirection(Angle(number(-3200, 3200)));
      reference().directionAt = now;
    }
  }

  void compareInside() override {
    MainController& controller = robot_.robot.controller();
    ASSERT_EQ(static_cast<int>(controller.getMode().id()), reference().mode) << cycles;
    ASSERT_EQ(controller.getData().stopped(), reference().stop) << cycles;
    ASSERT_EQ(robot_.system.calls, reference().held ? kHeld : kControlled) << cycles;
  }

  HostSteppedRobot& robot_;
  Runs rc_{false, 5, 12};
};

// Main Control with one control system that records its orders. Wheels and steering have no
// influence in this test.
class MainControlRobot final : public HostSteppedRobot {
 public:
  MainControlRobot() : HostSteppedRobot(host::HostEquipment::MainControl) {}
};

/// @brief The test runs 10000 random sequences of orders from both sources. In every cycle, the
/// robot behaves like a reference that was written from the requirements. The robot executes each
/// transition of the operation states and of the reading modes at least 100 times.
/// @verifies FR-10
/// @verifies FR-11
/// @verifies FR-12
/// @verifies FR-13
/// @verifies FR-15
/// @verifies FR-16
/// @verifies FR-17
/// @verifies FR-18
/// @verifies FR-19
/// @verifies FR-20
TEST(OperationStatesReference, RobotDoesWhatTheReferenceDoes) {
  compareInSequences<MainControlRobot, ComparisonInside>(10'000, 100);
}

}  // namespace
}  // namespace wr::test
