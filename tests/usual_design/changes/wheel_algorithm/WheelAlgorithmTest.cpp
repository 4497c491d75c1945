// A likely change: a new algorithm for the velocity of a wheel. Its internal set-point begins at
// the present velocity of the wheel. In each cycle, its internal set-point approaches the ordered
// set-point by at most 20 rpm.

#include "usual_design/host/OneWheelRobot.hpp"

namespace wr::test {
namespace {

template <class Design>
class RampedVelocity : public OfBothDesigns<Design> {};
TYPED_TEST_SUITE(RampedVelocity, Designs, DesignName);

// Returns the voltage that turns an unloaded motor at a velocity. For 100 rpm, it is 5236 mV.
constexpr int unloaded(int tenthRpm) {
  return 5236 * tenthRpm / 1000;
}

/// @brief In the first cycles after a step of the set-point, the internal set-point rises by 20 rpm
/// per cycle. The wheel gets the voltage of this internal set-point.
TYPED_TEST(RampedVelocity, RisesByTwentyRpmInACycle) {
  const scenario::PcOrder step{.id = 2, .wheels = {{{0, 3000}}}};
  this->robot.physics().setFault(plant::Fault::Hall, 0, true);  // the measured velocity stays 0
  this->robot.commandByPc();
  this->robot.orderedCycles(step, 1);
  EXPECT_EQ(this->robot.report().tension[0], unloaded(200));
  this->robot.orderedCycles(step, 1);
  EXPECT_GE(this->robot.report().tension[0], unloaded(400));
  EXPECT_LT(this->robot.report().tension[0], unloaded(600));
}

/// @brief The mean velocity over 2 s, beginning 3 s after the order, is within 5 percent of the
/// set-point.
TYPED_TEST(RampedVelocity, ReachesTheSetPoint) {
  const auto order = this->robot.velocity(1000);
  this->robot.commandByPc(order);
  this->robot.orderedCycles(order, 30);
  EXPECT_NEAR(this->robot.meanVelocity(order, 20), 1000, 50);
}

/// @brief A set-point of another quantity is applied immediately.
TYPED_TEST(RampedVelocity, LeavesOtherQuantitiesAsTheyAre) {
  const scenario::PcOrder order{.id = 3, .wheels = {{{1, 9000}}}};
  this->robot.commandByPc();
  this->robot.orderedCycles(order, 1);
  EXPECT_EQ(this->robot.report().tension[0], 9000);
}

}  // namespace
}  // namespace wr::test
