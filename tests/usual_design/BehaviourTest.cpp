// Tests of the behaviour of Main Control and one wheel. The same tests run for the baseline design
// and for the design of the robot.

#include <array>
#include <cstdlib>
#include <random>
#include <utility>

#include "services/SystemConstants.hpp"
#include "support/seed.hpp"
#include "usual_design/host/OneWheelRobot.hpp"

namespace wr::test {
namespace {

template <class Design>
class Behaviour : public OfBothDesigns<Design> {};
TYPED_TEST_SUITE(Behaviour, Designs, DesignName);

// ---- link to the PC ----------------------------------------------------------------------------

/// @brief A Hello is answered with a Welcome. The Welcome contains the session, the cycle period,
/// the number N of failed reads that lead to the last waiting state, and the cause of the reset.
TYPED_TEST(Behaviour, WelcomesThePc) {
  this->robot.hello();
  this->robot.cycle();
  const scenario::PcWelcome welcome = this->robot.welcome.value();
  EXPECT_EQ(welcome.session, 1);
  EXPECT_EQ(welcome.cyclePeriodMs, 100);
  EXPECT_EQ(welcome.waitingCycles, kN);
  EXPECT_EQ(welcome.resetCause, static_cast<int>(ResetCause::Pin));
  EXPECT_FALSE(this->robot.reported());
}

/// @brief A confirmed PC gets a report in each cycle, with the number and the time of the cycle.
TYPED_TEST(Behaviour, ReportsInEachCycle) {
  this->robot.connect();
  const scenario::PcReport first = this->robot.report();
  EXPECT_EQ(first.cycle, 2U);
  EXPECT_EQ(first.timeMs, 200U);
  EXPECT_EQ(first.source, kNobody);
  this->robot.silentCycle();
  EXPECT_EQ(this->robot.report().cycle, 3U);
  EXPECT_EQ(this->robot.report().timeMs, 300U);
}

/// @brief A Confirm of another session is counted as unexpected. An order before the connection is
/// also counted as unexpected.
TYPED_TEST(Behaviour, CountsWhatItDoesNotExpect) {
  this->robot.order({.id = 1});
  this->robot.hello();
  this->robot.cycle();
  this->robot.arrive(this->robot.pc.confirm(77));
  this->robot.confirm();
  this->robot.cycle();
  EXPECT_EQ(this->robot.report().unexpected, 2);
}

/// @brief Six kinds of bad frames are counted separately: damaged frames, frames that are too long,
/// frames of wrong length, frames of unknown type, frames of unknown version, and orders out of
/// range. The robot reads no order from these frames.
TYPED_TEST(Behaviour, CountsBadFrames) {
  this->robot.commandByPc();
  scenario::Bytes damaged = this->robot.pc.keepAlive();
  damaged[1] ^= 0x40U;
  this->robot.arrive(damaged);
  this->robot.arrive(scenario::Bytes(220, 1));
  this->robot.arrive(scenario::Bytes{0});
  this->robot.arrive(this->robot.pc.frame(3, {}, 9));
  this->robot.arrive(this->robot.pc.frame(0x55, {}));
  this->robot.arrive(this->robot.pc.frame(2, {}));
  this->robot.order({.id = 8, .steering = 3201});
  this->robot.cycle();
  const scenario::PcReport report = this->robot.report();
  EXPECT_EQ((std::array{report.damaged, report.tooLong, report.unknownVersion, report.unknownType,
                        report.wrongLength, report.outOfRange, report.unexpected}),
            (std::array<std::uint16_t, 7>{1, 1, 1, 1, 1, 1, 0}));
  EXPECT_FALSE(report.orderRead());
}

/// @brief If the PC is silent for a second, it is disconnected. Then it gets no report until it is
/// connected again.
TYPED_TEST(Behaviour, DisconnectsASilentPc) {
  this->robot.commandByPc();
  for (int i = 1; i < 9; ++i) {
    this->robot.cycle();
    EXPECT_TRUE(this->robot.reported()) << i;
  }
  this->robot.cycle();
  EXPECT_FALSE(this->robot.reported());
  this->robot.connect();
  EXPECT_TRUE(this->robot.reported());
}

/// @brief An order is read once. The next report still contains this order, and shows that no order
/// was read.
TYPED_TEST(Behaviour, ReadsAnOrderOnce) {
  this->robot.commandByPc();
  this->robot.order({.id = 40, .steering = 100, .wheels = {{{0, 20}, {1, -30}, {2, 40}, {0, 5}}}});
  this->robot.cycle();
  const scenario::PcReport report = this->robot.report();
  EXPECT_TRUE(report.orderRead());
  EXPECT_EQ(report.source, kPc);
  EXPECT_EQ(report.orderId, 40);
  EXPECT_EQ(report.steeringSetPoint, 100);
  EXPECT_EQ(report.quantity[1], 1);
  EXPECT_EQ(report.setPoint[1], -30);
  this->robot.silentCycle();
  EXPECT_FALSE(this->robot.report().orderRead());
  EXPECT_EQ(this->robot.report().orderId, 40);
}

// ---- reading modes and operation states --------------------------------------------------------

/// @brief The robot starts in the mode RC without set-points, and is held.
TYPED_TEST(Behaviour, BeginsHeldInTheModeRc) {
  this->robot.connect();
  EXPECT_EQ(this->robot.report().mode, kRc);
  EXPECT_TRUE(this->robot.report().held());
}

/// @brief After failed reads, the robot is first in the waiting states, and then in Reconnecting.
/// In the waiting states, the robot follows the last set-points. In Reconnecting, the robot is
/// held. An order leads back to Working.
TYPED_TEST(Behaviour, FailedReadsLeadToReconnecting) {
  const auto order = this->robot.velocity(300);
  this->robot.commandByPc(order);
  EXPECT_EQ(this->robot.report().state, kWorking);
  for (int failed = 1; failed <= kN + 1; ++failed) {
    this->robot.silentCycle();
    const scenario::PcReport report = this->robot.report();
    EXPECT_EQ(report.state, failed < kN    ? kWaiting
                            : failed == kN ? kWaitingN
                                           : kReconnecting)
        << failed;
    EXPECT_EQ(report.held(), failed > kN) << failed;
    EXPECT_EQ(report.setPoint[0], 300);
  }
  this->robot.commandByPcAgain(order);
  EXPECT_EQ(this->robot.report().state, kWorking);
  EXPECT_FALSE(this->robot.report().held());
}

/// @brief Without orders, the modes alternate. The number of failed reads before the first change
/// of the mode depends on the design.
TYPED_TEST(Behaviour, ModesAlternateWithoutOrders) {
  this->robot.commandByPc();
  int mode = kPc;
  for (int failed = 1; failed < 3 * kN; ++failed) {
    this->robot.silentCycle();
    if (failed >= kFirstAlternation<TypeParam>) {
      mode = mode == kPc ? kRc : kPc;
    }
    EXPECT_EQ(this->robot.report().mode, mode) << failed;
  }
}

/// @brief While there are pulses of the remote control, the robot follows the remote control.
/// Velocity and steering follow its sticks.
TYPED_TEST(Behaviour, FollowsTheRemoteControl) {
  this->robot.line.remoteControl().set(plant::Sticks{.velocity = 0.5, .steering = -1});
  this->robot.connect();
  this->robot.silentCycles(3);
  const scenario::PcReport report = this->robot.report();
  EXPECT_EQ(report.state, kWorking);
  EXPECT_EQ(report.source, kRc);
  EXPECT_EQ(report.steeringSetPoint, -3200);
  EXPECT_EQ(report.quantity[0], 0);
  EXPECT_NEAR(report.setPoint[0], 1500, 3 * 6);  // the width of a pulse varies by less than 3 us
  EXPECT_EQ(report.orderId, 0);
}

/// @brief When the sticks are in the centre, the ordered velocity is 0. Without pulses, there is no
/// order.
TYPED_TEST(Behaviour, RemoteControlInTheMiddleOrdersRest) {
  this->robot.line.remoteControl().set(plant::Sticks{.velocity = 0.03, .steering = 0});
  this->robot.connect();
  this->robot.silentCycles(2);
  EXPECT_TRUE(this->robot.report().orderRead());
  EXPECT_EQ(this->robot.report().setPoint[0], 0);
  this->robot.line.remoteControl().set(std::nullopt);
  this->robot.silentCycles(2);
  EXPECT_FALSE(this->robot.report().orderRead());
}

/// @brief When the PC orders a stop, the robot is held until the PC sends a neutral order without a
/// stop. Orders of the remote control do not end this stop.
TYPED_TEST(Behaviour, StopHoldsInEachMode) {
  this->robot.line.remoteControl().set(plant::Sticks{.velocity = 0.2, .steering = 0});
  this->robot.connect();
  this->robot.silentCycles(2);
  EXPECT_FALSE(this->robot.report().held());
  this->robot.order({.id = 9, .stop = true});
  this->robot.cycle();
  EXPECT_TRUE(this->robot.report().stop());
  EXPECT_TRUE(this->robot.report().held());
  this->robot.silentCycles(3);
  EXPECT_TRUE(this->robot.report().held());
  this->robot.order({.id = 10});
  this->robot.cycle();
  EXPECT_FALSE(this->robot.report().stop());
  EXPECT_FALSE(this->robot.report().held());
  EXPECT_EQ(this->robot.report().source, kRc);
}

/// @brief A stop order and an order that releases the stop arrive before the same cycle. The robot
/// is held in this cycle, and is not held in the next cycle.
TYPED_TEST(Behaviour, StopHoldsInTheCycleThatReceivesIt) {
  this->robot.commandByPc();
  this->robot.order({.id = 9, .stop = true});
  this->robot.order({.id = 10});
  this->robot.cycle();
  EXPECT_TRUE(this->robot.report().stop());
  EXPECT_EQ(this->robot.report().stopSources, 1 << kPc);
  EXPECT_TRUE(this->robot.report().held());
  EXPECT_EQ(this->robot.report().orderId, 10);
  this->robot.silentCycle();
  EXPECT_FALSE(this->robot.report().stop());
  EXPECT_FALSE(this->robot.report().held());
}

/// @brief Each cycle refreshes the watchdog.
TYPED_TEST(Behaviour, RefreshesTheWatchdogInEachCycle) {
  this->robot.cycles(7);
  EXPECT_EQ(this->robot.line.watchdog.refreshes(), 7U);
}

// ---- the wheel ---------------------------------------------------------------------------------

/// @brief The mean velocity over 2 s, beginning 2.5 s after the order, is within 2 percent of the
/// order.
TYPED_TEST(Behaviour, ReachesAVelocity) {
  const auto order = this->robot.velocity(1000);
  this->robot.commandByPc(order);
  this->robot.orderedCycles(order, 25);
  EXPECT_NEAR(this->robot.meanVelocity(order, 20), 1000, 20);
  EXPECT_GT(this->robot.report().position[0], 0);
  EXPECT_EQ(this->robot.report().rejectedEdges[0], 0);
  EXPECT_EQ(this->robot.report().measured & 7U, 7U);
}

/// @brief When the soft start has ended, exactly the ordered voltage is applied.
TYPED_TEST(Behaviour, AppliesATension) {
  const scenario::PcOrder order{.id = 3, .wheels = {{{1, 9000}}}};
  this->robot.commandByPc(order);
  this->robot.orderedCycles(order, 3);
  EXPECT_EQ(this->robot.report().tension[0], 9000);
  EXPECT_EQ(this->robot.report().applied & 1U, 1U);
  EXPECT_EQ(this->robot.line.pins.wheels[0].pwm.dutyCycle(), DutyCycle(3750));
  EXPECT_TRUE(this->robot.line.pins.wheels[0].enable.isOn());
}

/// @brief 1 s after the order, the current is within 5 percent of the order.
TYPED_TEST(Behaviour, ReachesACurrent) {
  const scenario::PcOrder order{.id = 4, .wheels = {{{2, 6000}}}};
  this->robot.commandByPc(order);
  this->robot.orderedCycles(order, 11);
  EXPECT_NEAR(this->robot.report().current[0], 6000, 300);
}

/// @brief The orientation of a wheel changes only while the wheel is slow.
TYPED_TEST(Behaviour, SlowsDownBeforeItReverses) {
  const auto forwards = this->robot.velocity(800);
  const auto backwards = this->robot.velocity(-800);
  this->robot.commandByPc(forwards);
  this->robot.orderedCycles(forwards, 20);
  bool turned = false;
  for (int i = 0; i < 60 && !turned; ++i) {
    const int before = this->robot.report().velocity[0];
    this->robot.orderedCycles(backwards, 1);
    turned = this->robot.line.pins.wheels[0].orientation.isOn();
    if (turned) {
      EXPECT_LT(std::abs(before), 400);
    }
  }
  EXPECT_TRUE(turned);
  this->robot.orderedCycles(backwards, 30);
  EXPECT_NEAR(this->robot.meanVelocity(backwards, 20), -800, 40);
}

/// @brief When the robot is held, the voltage of the wheel falls step by step to 0.
TYPED_TEST(Behaviour, LowersTheTensionWhenItIsHeld) {
  const scenario::PcOrder order{.id = 3, .wheels = {{{1, 9000}}}};
  this->robot.commandByPc(order);
  this->robot.orderedCycles(order, 3);
  for (const int left : {6600, 4200, 1800, 0, 0}) {
    this->robot.order({.id = 5, .stop = true});
    this->robot.cycle();
    EXPECT_EQ(this->robot.report().tension[0], left);
  }
  EXPECT_EQ(this->robot.line.pins.wheels[0].pwm.dutyCycle(), DutyCycle(0));
}

/// @brief A wheel is stopped if it has voltage, but its Hall sensors have no edges. A hold does not
/// end this stop.
TYPED_TEST(Behaviour, StopsAWheelWithoutMotionFeedback) {
  this->robot.physics().setFault(plant::Fault::Hall, 0, true);
  const scenario::PcOrder order{.id = 3, .wheels = {{{1, 9000}}}};
  this->robot.commandByPc(order);
  this->robot.orderedCycles(order, 100);
  EXPECT_EQ(this->robot.report().blindWheels, 1);
  EXPECT_EQ(this->robot.report().tension[0], 0);
  this->robot.order({.id = 5, .stop = true});
  this->robot.cycle();
  EXPECT_EQ(this->robot.report().blindWheels, 1);
}

/// @brief If the current of a wheel is missing, the wheel is stopped. The report shows that the
/// current is missing.
TYPED_TEST(Behaviour, StopsAWheelWithoutCurrent) {
  const auto order = this->robot.velocity(500);
  this->robot.commandByPc(order);
  this->robot.orderedCycles(order, 10);
  EXPECT_GT(this->robot.report().tension[0], 0);
  this->robot.physics().setFault(plant::Fault::Current, 0, true);
  this->robot.orderedCycles(order, 10);
  EXPECT_EQ(this->robot.report().tension[0], 0);
  EXPECT_EQ(this->robot.report().measured & 2U, 0U);
}

/// @brief A current that is too high causes an overcurrent trip. The wheel gets no voltage, and
/// brakes with its driver on. A hold does not end the trip.
TYPED_TEST(Behaviour, OvercurrentTripsTheWheel) {
  this->robot.physics().setFault(plant::Fault::Block, 0, true);
  const scenario::PcOrder order{.id = 3, .wheels = {{{1, 24000}}}};
  this->robot.commandByPc(order);
  this->robot.orderedCycles(order, 6);
  EXPECT_EQ(this->robot.report().cutOffs, 1);
  EXPECT_EQ(this->robot.report().applied & 1U, 0U);
  EXPECT_TRUE(this->robot.line.pins.wheels[0].enable.isOn());
  EXPECT_EQ(this->robot.line.pins.wheels[0].pwm.dutyCycle(), DutyCycle(0));
  this->robot.order({.id = 5, .stop = true});
  this->robot.cycle();
  EXPECT_EQ(this->robot.report().cutOffs, 1);
  this->robot.orderedCycles({.id = 6, .wheels = {{{1, 2000}}}}, 2);
  EXPECT_EQ(this->robot.line.pins.wheels[0].pwm.dutyCycle(), DutyCycle(0));
}

/// @brief An acknowledgement in the first cycle after a trip does not switch the driver on. This
/// cycle reports the trip, and the acknowledgement of the next cycle ends the trip.
TYPED_TEST(Behaviour, AnAcknowledgementWaitsForTheReportOfATrip) {
  this->robot.commandByPc({.id = 2, .wheels = {{{1, 12000}}}});
  this->robot.physics().setFault(plant::Fault::Block, 0, true);
  this->robot.orderedCycles({.id = 3, .wheels = {{{1, 24000}}}}, 1);
  ASSERT_EQ(this->robot.report().tension[0], 24000);
  this->robot.order({.id = 4, .acknowledge = true});
  this->robot.cycle();
  EXPECT_EQ(this->robot.report().cutOffs, 1);
  EXPECT_FALSE(this->robot.line.pins.wheels[0].enable.isOn());
  this->robot.order({.id = 5, .acknowledge = true});
  this->robot.cycle();
  EXPECT_EQ(this->robot.report().cutOffs, 0);
}

// ---- both side by side -------------------------------------------------------------------------

// Two robots on one serial line. Both robots get the same bytes.
struct SideBySide {
  OneWheelLine<UsualDesign> usual;
  OneWheelLine<PatternDesign> patterns;
  scenario::PcSender pc;

  void give(const scenario::Bytes& bytes) {
    usual.send(bytes);
    patterns.send(bytes);
  }

  // Runs a cycle of both robots, and returns the sent bytes of each robot.
  std::pair<scenario::Bytes, scenario::Bytes> cycleApart() {
    usual.runThroughPulse();
    patterns.runThroughPulse();
    return {usual.takeSent(), patterns.takeSent()};
  }

  // Runs a cycle in which both robots get the same bytes. Checks that both robots send the same
  // bytes.
  void cycle(const scenario::Bytes& bytes) {
    give(bytes);
    const auto [ofUsual, ofPatterns] = cycleApart();
    EXPECT_EQ(ofUsual, ofPatterns);
    EXPECT_FALSE(ofUsual.empty());
  }
};

// Returns an order of any quantity and value, sometimes with a stop.
scenario::PcOrder anyOrder(std::mt19937& random, std::uint16_t id) {
  const auto between = [&](int least, int greatest) {
    return std::uniform_int_distribution<int>(least, greatest)(random);
  };
  constexpr const SystemConstants& kConstants = SystemConstants::instance();
  constexpr std::array<int, 3> kLimits{kConstants.velocityLimit().count(),
                                       kConstants.tensionLimit().count(),
                                       kConstants.currentLimit().count()};
  constexpr int kSteering = kConstants.steeringLimit().count();
  const auto quantity = static_cast<std::uint8_t>(between(0, 2));
  const int limit = kLimits.at(quantity);
  return {.id = id,
          .steering = static_cast<std::int16_t>(between(-kSteering, kSteering)),
          .wheels = {{{quantity, static_cast<std::int16_t>(between(-limit, limit))}}},
          .stop = between(1, 8) == 1};
}

/// @brief After the PC has begun to send orders, both robots get the same bytes. Both robots then
/// send the same bytes, for any order and any movement of the wheel.
TEST(BothDesigns, SendTheSameBytes) {
  std::mt19937 random(seed());
  SideBySide both;
  // After N + 2 failed reads, both robots read orders from the PC.
  both.cycle(both.pc.hello());
  both.give(both.pc.confirm(1));
  for (int failed = 2; failed <= kN + 2; ++failed) {
    both.cycleApart();
    both.give(both.pc.keepAlive());
  }
  scenario::PcOrder order{.id = 1};
  for (std::uint16_t id = 2; id < 1500 && !testing::Test::HasFailure(); ++id) {
    if (random() % 8 == 0) {
      order = anyOrder(random, id);
    }
    const bool silent = id % 5 == 0;  // one failed read does not change the mode
    both.cycle(silent ? both.pc.keepAlive() : both.pc.order(order));
  }
}

}  // namespace
}  // namespace wr::test
