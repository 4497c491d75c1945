// A likely change: a state that warns. After K - 1 = N - 2 failed reads, the next failed read sets
// the state WaitingK. This state switches a lamp on. The robot continues to drive in this state.
// With and without the change, the robot stays in the waiting states for N failed reads. The next
// failed read sets Reconnecting.

#include "sim/host/HostDigitalOutput.hpp"
#include "usual_design/host/OneWheelRobot.hpp"

namespace wr::test {
namespace {

constexpr int kWaitingK = 4;

// A lamp, and a design that uses the lamp for the warning.
template <class Design>
class WarningState : public testing::Test {
 protected:
  host::HostDigitalOutput lamp;
  OneWheelRobot<Design> robot{lamp};
};
TYPED_TEST_SUITE(WarningState, Designs, DesignName);

/// @brief The lamp is on only in the cycle before the last waiting state. In this cycle, the robot
/// follows its set-points.
TYPED_TEST(WarningState, WarnsBeforeTheLastWaitingState) {
  this->robot.commandByPc();
  EXPECT_FALSE(this->lamp.isOn());
  for (int failed = 1; failed <= kN + 1; ++failed) {
    this->robot.silentCycle();
    const bool warns = failed == kN - 1;
    EXPECT_EQ(this->lamp.isOn(), warns) << failed;
    EXPECT_EQ(this->robot.report().state == kWaitingK, warns) << failed;
    EXPECT_EQ(this->robot.report().held(), failed > kN) << failed;
  }
  EXPECT_EQ(this->robot.report().state, kReconnecting);
}

/// @brief A message ends the warning.
TYPED_TEST(WarningState, EndsWithAMessage) {
  this->robot.commandByPc();
  this->robot.silentCycles(kN - 1);
  EXPECT_TRUE(this->lamp.isOn());
  this->robot.orderedCycles({.id = 5}, 1);
  EXPECT_FALSE(this->lamp.isOn());
  EXPECT_EQ(this->robot.report().state, kWorking);
}

}  // namespace
}  // namespace wr::test
