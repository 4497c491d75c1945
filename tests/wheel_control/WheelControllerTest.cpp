#include "wheel_control/WheelController.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <functional>
#include <limits>

#include "wheel_control/ControlledWheel.hpp"

namespace wr::test {
namespace {

class WheelControllerTest : public testing::Test, protected ControlledWheel {
 protected:
  /// Runs a cycle in which the wheel does not turn.
  void controlStanding(const WheelSetPoint& setPoint) {
    measure(Velocity(), Current());
    controller.control(setPoint, measured());
  }
};

/// @brief In the cycle that reads an order of up to 12 V, the output already has the ordered
/// voltage. The error is at most the greater of 0.5 % and 6 mV.
/// @verifies FR-80
TEST_F(WheelControllerTest, FR80_TensionStandsAtTheOutputAtOnce) {
  for (const std::int16_t tension :
       {std::int16_t{12000}, std::int16_t{7001}, std::int16_t{999}, std::int16_t{1}}) {
    control(tensionOf(tension));
    EXPECT_EQ(controller.applied(), Tension(tension));
    EXPECT_NEAR(output().count(), tension, std::max(tension * 0.005, 6.0));
  }
}

/// @brief The rise of an ordered voltage is limited to 12 V per cycle.
/// @verifies FR-81
TEST_F(WheelControllerTest, FR81_RiseIsLimited) {
  control(tensionOf(24000));
  EXPECT_EQ(output(), Tension(12000));
  control(tensionOf(24000));
  EXPECT_EQ(output(), Tension(24000));
}

/// @brief Each quantity is controlled by a separate algorithm.
/// @verifies FR-80
/// @verifies FR-82
/// @verifies FR-85
TEST_F(WheelControllerTest, FR80_FR82_FR85_EachQuantityHasItsAlgorithm) {
  control(tensionOf(1000));
  EXPECT_EQ(controller.applied(), Tension(1000));
  control(velocityOf(1000));
  EXPECT_EQ(controller.applied(), Tension(5236));
  control(currentOf(1000));
  EXPECT_EQ(controller.applied(), Tension(1500));
}

/// @brief When the ordered quantity changes, the memory of the controller is cleared.
/// @verifies FR-301
TEST_F(WheelControllerTest, FR301_AnotherQuantityStartsAfresh) {
  for (int cycle = 0; cycle < 5; ++cycle) {
    control(velocityOf(1000), Velocity(100), Current(3500));
  }
  EXPECT_GT(controller.applied(), Tension(6000));
  control(tensionOf(5000), Velocity(100));
  control(velocityOf(1000), Velocity(100));
  EXPECT_EQ(controller.applied(), Tension(5236));
}

/// @brief If the demand exceeds the supply voltage, the wheel gets the supply voltage. Because the
/// algorithm gets the applied voltage, its integral does not grow while the supply limits the
/// voltage.
/// @verifies FR-86
/// @verifies FR-301
TEST_F(WheelControllerTest, FR86_DemandStaysWithinTheSupply) {
  for (int cycle = 0; cycle < 50; ++cycle) {
    control(currentOf(10000), Velocity(3000), Current(4000));
  }
  EXPECT_EQ(controller.applied(), Tension(24000));
  control(currentOf(0), Velocity(3000), Current(4000));
  EXPECT_EQ(controller.applied(), Tension(15708))
      << "the voltage must be exactly the induced voltage at 300 rpm";
}

/// @brief A measured value can be used for 150 ms.
/// @verifies FR-90
/// @verifies FR-127
TEST_F(WheelControllerTest, FR90_MeasuredValuesGrowOld) {
  EXPECT_EQ(controller.velocity(time.now()), std::nullopt);
  EXPECT_EQ(controller.current(time.now()), std::nullopt);
  measure(Velocity(123), Current(456));
  time.advance(milliseconds(150));
  EXPECT_EQ(controller.velocity(time.now()), Velocity(123));
  EXPECT_EQ(controller.current(time.now()), Current(456));
  time.advance(Microseconds(1));
  EXPECT_EQ(controller.velocity(time.now()), std::nullopt);
  EXPECT_EQ(controller.current(time.now()), std::nullopt);
}

/// @brief Without a measured velocity, the wheel is stopped step by step.
/// @verifies FR-90
TEST_F(WheelControllerTest, FR90_WithoutVelocityItIsStopped) {
  control(tensionOf(5000));
  for (const int left : {2600, 200, 0, 0}) {
    time.advance(milliseconds(200));
    currents.write(Current(), time.now());
    controller.control(tensionOf(5000), measured());
    EXPECT_EQ(controller.applied(), Tension(left));
  }
}

/// @brief Without a measured current, the wheel is stopped. When the current is available again,
/// control starts without memory.
/// @verifies FR-90
TEST_F(WheelControllerTest, FR90_WithoutCurrentItIsStopped) {
  control(velocityOf(1500));
  control(velocityOf(1500), Velocity(100));
  time.advance(milliseconds(200));
  velocities.write(Velocity(500), time.now());
  controller.control(velocityOf(1500), measured());
  EXPECT_LT(controller.applied(), Tension(7854));
  control(velocityOf(1500), Velocity(500));
  EXPECT_EQ(controller.applied(), Tension(7854));
}

/// @brief When a wheel was stopped because of a missing current, control starts again without the
/// voltage that the load needed before.
/// @verifies FR-90
/// @verifies FR-301
TEST_F(WheelControllerTest, FR90_ControlStartsWithoutMemory) {
  for (int cycle = 0; cycle < 5; ++cycle) {
    control(velocityOf(1000), Velocity(100), Current(3500));
  }
  ASSERT_GT(controller.applied(), Tension(6000));
  time.advance(milliseconds(200));
  velocities.write(Velocity(100), time.now());
  controller.control(velocityOf(1000), measured());
  control(velocityOf(1000), Velocity(100), Current(3500));
  EXPECT_EQ(controller.applied(), Tension(5236));
}

/// @brief A wheel that was never measured gets no voltage.
/// @verifies FR-90
TEST_F(WheelControllerTest, FR90_UnmeasuredWheelGetsNoTension) {
  controller.control(tensionOf(5000), measured());
  EXPECT_EQ(controller.applied(), Tension(0));
  EXPECT_EQ(output(), Tension(0));
}

/// @brief A halt lowers the voltage by 2.4 V per cycle, and then short-circuits the wheel.
/// @verifies FR-88
TEST_F(WheelControllerTest, FR88_HaltLowersThenShortCircuits) {
  constexpr int kFall = 2400;  // [mV per cycle]
  control(tensionOf(6000));
  for (const int left : {6000 - kFall, 6000 - 2 * kFall, 0, 0}) {
    controller.halt();
    EXPECT_EQ(controller.applied(), Tension(left));
    EXPECT_EQ(output(), Tension(left));
  }
  EXPECT_TRUE(enable.isOn());
}

/// @brief If an order interrupts a halt, the voltage rises from its value at the end of the halt.
/// @verifies FR-81
TEST_F(WheelControllerTest, FR81_RiseBeginsAtWhatAHaltLeft) {
  control(tensionOf(10000));
  controller.halt();
  control(tensionOf(24000));
  EXPECT_EQ(controller.applied(), Tension(7600 + 12000));
}

/// @brief After a halt, a reversal begins with the voltage that the wheel had at the end of the
/// halt. The orientation changes only without voltage.
/// @verifies FR-87
TEST_F(WheelControllerTest, FR87_ReverseBeginsAtWhatAHaltLeft) {
  control(tensionOf(10000));
  controller.halt();
  for (const int left : {5200, 2800, 400, 0}) {
    control(tensionOf(-5000));
    EXPECT_EQ(output(), Tension(left));
    EXPECT_FALSE(orientation.isOn());
  }
  control(tensionOf(-5000));
  EXPECT_EQ(controller.applied(), Tension(-5000));
  EXPECT_TRUE(orientation.isOn());
}

/// @brief If a wheel does not move, it counts as a wheel without motion feedback after 6 V for 8
/// cycles, 3 V for 15 cycles or 12 V for 4 cycles. The wheel is then stopped step by step.
/// @verifies FR-91
TEST_F(WheelControllerTest, FR91_VoltageAndTimeWithoutMotion) {
  struct Case {
    std::int16_t tension;
    int cycles;
  };
  for (const auto& [tension, cycles] :
       {Case{6000, 8}, Case{3000, 15}, Case{12000, 4}, Case{2100, 22}, Case{-9000, 5}}) {
    ControlledWheel one;
    one.control(tensionOf(-100));  // a reversal takes two slow cycles
    one.control(tensionOf(-100));
    one.control(tensionOf(0));
    const auto stand = [&one, applied = tensionOf(tension)] {
      one.measure(Velocity(), Current());
      one.controller.control(applied, one.measured());
    };
    for (int i = 0; i < 3 && one.controller.applied() != Tension(tension); ++i) {
      stand();
    }
    ASSERT_EQ(one.controller.applied(), Tension(tension));
    for (int cycle = 1; cycle < cycles; ++cycle) {
      stand();
      EXPECT_FALSE(one.controller.blind()) << tension << " " << cycle;
    }
    stand();
    EXPECT_TRUE(one.controller.blind()) << tension;
    EXPECT_LT(std::abs(one.controller.applied()->count()), std::abs(tension));
  }
}

/// @brief If the load keeps a wheel at rest, its motor draws the full current of its voltage. If
/// the current is more than half of the full current, only a sixteenth of a voltage up to 14 V is
/// counted. Of a higher voltage, only an eighth is counted. An order of up to 3.2 V is always
/// counted fully.
/// @verifies FR-91
TEST_F(WheelControllerTest, FR91_AHeldWheelHasTime) {
  struct Case {
    std::int16_t tension;
    std::int32_t current;  // [mA]
    int cycles;
  };
  for (const auto& [tension, current, cycles] :
       {Case{6000, 4000, 120}, Case{6000, 2001, 120}, Case{6000, 2000, 8}, Case{14000, 9000, 52},
        Case{14100, 9000, 26}, Case{3300, 2000, 219}, Case{3200, 2000, 15}, Case{-6000, -4000, 120},
        Case{-6000, -2001, 120}, Case{-6000, -2000, 8}, Case{-6000, 4000, 8}}) {
    ControlledWheel one;
    one.control(tensionOf(tension));  // a reversal and a soft start need one cycle each
    one.control(tensionOf(tension));
    one.controller.release();
    int needed = 0;
    while (!one.controller.blind() && needed < 1000) {
      one.measure(Velocity(), Current(current));
      one.controller.control(tensionOf(tension), one.measured());
      ++needed;
    }
    EXPECT_NEAR(needed, cycles, 1) << tension << " " << current;
  }
}

/// @brief If the order is a voltage order, a voltage of up to 3.2 V is always counted fully. At
/// 3.201 V, or for an order of current or velocity, only a sixteenth is counted if the load keeps
/// the wheel at rest.
/// @verifies FR-91
TEST_F(WheelControllerTest, FR91_AHeldWheelWithoutAVoltageOrderHasTime) {
  struct Case {
    WheelSetPoint setPoint;
    Velocity velocity;     // measured velocity
    std::int32_t tension;  // voltage at the output [mV]
    int cycles;
  };
  for (const auto& [setPoint, velocity, tension, cycles] :
       {Case{currentOf(2000), Velocity(), 3000, 241},
        Case{velocityOf(500), Velocity(500), 2618, 276},
        Case{tensionOf(3000), Velocity(), 3000, 15}, Case{tensionOf(3200), Velocity(), 3200, 15},
        Case{tensionOf(3201), Velocity(), 3201, 225}}) {
    ControlledWheel one;
    one.control(setPoint, velocity, Current(2000));
    int needed = 0;
    while (!one.controller.blind() && needed < 1000) {
      ASSERT_EQ(one.controller.applied(), Tension(tension));
      one.measure(velocity, Current(2000));
      one.controller.control(setPoint, one.measured());
      ++needed;
    }
    EXPECT_NEAR(needed, cycles, 1) << tension;
  }
}

/// @brief If a wheel was stopped because it has no motion feedback, it stays stopped until the
/// release. Neither a motion nor a halt ends the stop.
/// @verifies FR-91
TEST_F(WheelControllerTest, FR91_NoMotionUntilReleased) {
  for (int cycle = 0; cycle < 11; ++cycle) {
    controlStanding(tensionOf(7000));
  }
  for (int cycle = 0; cycle < 5; ++cycle) {
    control(tensionOf(7000));
    controller.halt();
    EXPECT_TRUE(controller.blind());
  }
  EXPECT_EQ(controller.applied(), Tension(0));
  controller.release();
  EXPECT_FALSE(controller.blind());
  control(tensionOf(7000));
  EXPECT_EQ(controller.applied(), Tension(7000));
}

/// @brief The limit of 4.5 V s for the sum of voltage times time is exact. The sum begins at 0
/// after a motion, after the release, and after cycles whose voltage may be too low to turn a
/// wheel.
/// @verifies FR-91
TEST_F(WheelControllerTest, FR91_TheCountIsExact) {
  constexpr std::int32_t kLimit = 4500 * 10;  // 4.5 V s [mV cycles]: a second has ten cycles
  constexpr std::int16_t kUsual = 5000;
  constexpr int kUsualCycles = 7;
  const auto stand = [](ControlledWheel& one, std::int32_t tension) {
    one.measure(Velocity(), Current());
    one.controller.control(tensionOf(static_cast<std::int16_t>(tension)), one.measured());
  };
  // Each of the three functions below ends with the voltage kUsual at the output. The result is the
  // sum of voltage times time at the end of the function [mV cycles].
  const auto afterMotion = [](ControlledWheel& one) {
    one.control(tensionOf(kUsual));
    return 0;
  };
  const auto afterRelease = [&](ControlledWheel& one) {
    while (!one.controller.blind()) {
      stand(one, 7000);
    }
    const std::int32_t left = one.controller.applied()->count();
    one.controller.release();
    stand(one, kUsual);
    return left;
  };
  const auto afterLowVoltage = [&](ControlledWheel& one) {
    for (int cycle = 0; cycle < 3; ++cycle) {
      stand(one, 2000);
    }
    stand(one, kUsual);
    return 0;
  };
  const std::array<std::function<std::int32_t(ControlledWheel&)>, 3> begins{
      afterMotion, afterRelease, afterLowVoltage};
  for (std::size_t begin = 0; begin < begins.size(); ++begin) {
    for (const std::int32_t missing : {0, 1}) {
      ControlledWheel one;
      const std::int32_t last = kLimit - begins.at(begin)(one) - kUsualCycles * kUsual - missing;
      for (int cycle = 1; cycle <= kUsualCycles; ++cycle) {
        stand(one, cycle < kUsualCycles ? kUsual : last);
      }
      EXPECT_FALSE(one.controller.blind()) << begin;
      stand(one, kUsual);
      EXPECT_EQ(one.controller.blind(), missing == 0) << begin;
    }
  }
}

/// @brief The sum of voltage times time falls by 2 V s per second while the voltage may be too low
/// to turn a wheel. The sum never falls below 0.
/// @verifies FR-91
TEST_F(WheelControllerTest, FR91_TheCountFalls) {
  control(tensionOf(7000));
  for (int cycle = 0; cycle < 5; ++cycle) {
    controlStanding(tensionOf(cycle < 4 ? 7000 : 1000));  // counts 35000 mV cycles
  }
  for (int cycle = 0; cycle < 10; ++cycle) {
    controlStanding(tensionOf(cycle < 9 ? 1000 : 7000));  // the sum is still 15000 mV cycles
  }
  for (int cycle = 0; cycle < 5; ++cycle) {
    EXPECT_FALSE(controller.blind()) << cycle;
    controlStanding(tensionOf(7000));
  }
  EXPECT_TRUE(controller.blind());
}

/// @brief The sum of voltage times time also falls by 2 V s per second while the velocity order is
/// 0, even if the voltage is above 2 V.
/// @verifies FR-91
TEST_F(WheelControllerTest, FR91_TheCountFallsWithAVelocityOrderOfZero) {
  for (int cycle = 0; cycle < 6; ++cycle) {
    control(velocityOf(500), Velocity(200), Current(3000));  // the load needs a voltage
  }
  const auto standAt = [this](std::int16_t velocity) {
    measure(Velocity(), Current());
    controller.control(velocityOf(velocity), measured());
  };
  std::int32_t sum = 0;
  while (sum < 25000) {
    sum += controller.applied()->count();
    standAt(500);
  }
  for (int cycle = 0; cycle < 10; ++cycle) {
    ASSERT_GT(controller.applied(), Tension(2000));
    standAt(0);
  }
  sum = std::max(sum - 10 * 2000, 0);
  ASSERT_LT(sum + controller.applied()->count(), 45000);
  while (sum + controller.applied()->count() < 45000) {
    sum += controller.applied()->count();
    standAt(500);
    EXPECT_FALSE(controller.blind());
  }
  standAt(500);
  EXPECT_TRUE(controller.blind());
}

/// @brief A halt does not clear the sum of voltage times time. Each pulse of voltage adds to the
/// sum.
/// @verifies FR-91
TEST_F(WheelControllerTest, FR91_HaltKeepsTheCount) {
  for (int pulse = 0; pulse < 3; ++pulse) {
    EXPECT_FALSE(controller.blind());
    for (int cycle = 0; cycle < 3; ++cycle) {
      controlStanding(tensionOf(9000));
    }
    controller.halt();
  }
  EXPECT_TRUE(controller.blind());
}

/// @brief One edge forwards and one edge backwards do not count as motion, because a single working
/// sensor causes such edges.
/// @verifies FR-91
TEST_F(WheelControllerTest, FR91_OneEdgeToAndFroIsNoMotion) {
  control(tensionOf(7000));
  for (int cycle = 0; cycle < 8; ++cycle) {
    position = position + HallCount(cycle % 2 == 0 ? 1 : -1);
    controlStanding(tensionOf(7000));
  }
  EXPECT_TRUE(controller.blind());
}

/// @brief At the end of its range the position continues at the other end. One edge across this end
/// is no motion, and two edges are a motion.
/// @verifies FR-91
/// @verifies FR-177
TEST_F(WheelControllerTest, FR91_PositionsContinueAtTheOtherEnd) {
  constexpr HallCount kLast(std::numeric_limits<std::int32_t>::max());
  constexpr HallCount kFirst(std::numeric_limits<std::int32_t>::min());
  for (const bool moves : {true, false}) {
    controller.release();
    position = kLast;
    controlStanding(tensionOf(7000));
    for (int cycle = 0; cycle < 8; ++cycle) {
      position = cycle % 2 != 0 ? kLast : moves ? kFirst + HallCount(1) : kFirst;
      controlStanding(tensionOf(7000));
    }
    EXPECT_EQ(controller.blind(), !moves);
  }
}

/// @brief If a wheel does not turn at 2.0 V, it never counts as a wheel without motion feedback.
/// This voltage may be too low to turn a wheel. A creeping wheel counts as a moving wheel.
/// @verifies FR-91
TEST_F(WheelControllerTest, FR91_LowVoltageAndCreeping) {
  for (int cycle = 0; cycle < 100; ++cycle) {
    controlStanding(tensionOf(2000));
  }
  EXPECT_FALSE(controller.blind());
  for (int cycle = 0; cycle < 60; ++cycle) {
    position = position + HallCount(cycle % 2 == 0 ? -1 : 0);  // 5 rpm
    controlStanding(tensionOf(10000));
  }
  EXPECT_FALSE(controller.blind());
}

/// @brief If the ordered velocity of a wheel is 0, the wheel keeps the voltage that its load needs,
/// without a time limit.
/// @verifies FR-91
TEST_F(WheelControllerTest, FR91_StandingStillOnASlopeIsNoFault) {
  for (int cycle = 0; cycle < 6; ++cycle) {
    control(velocityOf(500), Velocity(200), Current(3000));
  }
  for (int cycle = 0; cycle < 300; ++cycle) {
    measure(Velocity(), Current(3000));
    controller.control(velocityOf(0), measured());
    EXPECT_GT(controller.applied(), Tension(3000));
  }
  EXPECT_FALSE(controller.blind());
}

/// @brief A reversal waits until a wheel without voltage is slow. The reversal may wait for 2 s. If
/// it waits for one more cycle, it is late, and the wheel is then stopped until the release.
/// @verifies FR-222
TEST_F(WheelControllerTest, FR222_ReversalThatWaitsTooLongIsLate) {
  control(tensionOf(2000), Velocity(1000));
  for (int cycle = 0; cycle < 20; ++cycle) {
    control(tensionOf(-2000), Velocity(800));
    EXPECT_FALSE(controller.reversalLate());
  }
  control(tensionOf(-2000), Velocity(800));
  EXPECT_TRUE(controller.reversalLate());
  for (int cycle = 0; cycle < 5; ++cycle) {
    control(tensionOf(-2000), Velocity(0));
    controller.halt();
    EXPECT_TRUE(controller.reversalLate());
    EXPECT_EQ(output(), Tension(0));
  }
  controller.release();
  EXPECT_FALSE(controller.reversalLate());
  control(tensionOf(-2000), Velocity(0));
  control(tensionOf(-2000), Velocity(0));
  EXPECT_EQ(output(), Tension(-1999));
}

/// @brief The waiting time of a reversal begins again at a halt, at an overcurrent trip, and at the
/// release.
/// @verifies FR-222
TEST_F(WheelControllerTest, FR222_TheWaitBeginsAgain) {
  const auto halt = [](WheelController& one) { one.halt(); };
  const auto trip = [](WheelController& one) { one.driverOff(); };
  const auto release = [](WheelController& one) { one.release(); };
  const std::array<std::function<void(WheelController&)>, 3> ends{halt, trip, release};
  for (std::size_t end = 0; end < ends.size(); ++end) {
    ControlledWheel one;
    one.control(tensionOf(2000), Velocity(1000));
    for (int cycle = 0; cycle < 15; ++cycle) {
      one.control(tensionOf(-2000), Velocity(800));
    }
    ends.at(end)(one.controller);
    for (int cycle = 0; cycle < 20; ++cycle) {
      one.control(tensionOf(-2000), Velocity(800));
      EXPECT_FALSE(one.controller.reversalLate()) << end << " " << cycle;
    }
    one.control(tensionOf(-2000), Velocity(800));
    EXPECT_TRUE(one.controller.reversalLate()) << end;
  }
}

/// @brief A change of the ordered quantity does not restart the waiting time of a reversal.
/// @verifies FR-222
TEST_F(WheelControllerTest, FR222_AnotherQuantityContinuesTheWait) {
  control(tensionOf(2000), Velocity(1000));
  for (int cycle = 0; cycle < 20; ++cycle) {
    control(cycle < 15 ? tensionOf(-5000) : velocityOf(-1000), Velocity(900));
    EXPECT_FALSE(controller.reversalLate()) << cycle;
  }
  control(velocityOf(-1000), Velocity(900));
  EXPECT_TRUE(controller.reversalLate());
}

/// @brief The velocity order and the demand have the direction opposite to the orientation. A
/// reversal waits even if the order is only 0.1 rpm, or the demand is only 0.5 V. With a velocity
/// order of 0 or a smaller demand, no reversal waits.
/// @verifies FR-222
TEST_F(WheelControllerTest, FR222_WhichReversalsWait) {
  struct Case {
    bool backwards;  // orientation of the wheel, and direction in which a slope turns it
    WheelSetPoint setPoint;
    bool late;
  };
  for (const auto& [backwards, setPoint, late] :
       {Case{false, velocityOf(-1), true}, Case{true, velocityOf(1), true},
        Case{false, velocityOf(0), false}, Case{true, velocityOf(0), false},
        Case{false, tensionOf(-500), true}, Case{true, tensionOf(500), true},
        Case{false, tensionOf(-499), false}, Case{true, tensionOf(499), false}}) {
    const int sign = backwards ? -1 : 1;
    ControlledWheel one;
    for (int cycle = 0; cycle < 3; ++cycle) {
      one.control(tensionOf(static_cast<std::int16_t>(sign * 2000)), Velocity(sign * 900));
    }
    ASSERT_EQ(one.controller.applied(), Tension(sign * 2000));
    for (int cycle = 0; cycle < 30; ++cycle) {
      one.control(setPoint, Velocity(sign * 900));
    }
    EXPECT_EQ(one.controller.reversalLate(), late) << backwards << " " << setPoint.value;
  }
}

/// @brief A wheel that creeps down a slope at 39 rpm can be driven uphill.
/// @verifies FR-87
TEST_F(WheelControllerTest, FR87_CreepingWheelCanBeReversed) {
  control(tensionOf(2000), Velocity(390));
  for (int cycle = 0; cycle < 3; ++cycle) {
    control(tensionOf(-5000), Velocity(390));
  }
  EXPECT_EQ(controller.applied(), Tension(-5000));
  EXPECT_FALSE(controller.reversalLate());
}

/// @brief If a slope drags a wheel faster than its set-point, the demand brakes the wheel. This
/// braking never counts as a late reversal.
/// @verifies FR-222
TEST_F(WheelControllerTest, FR222_ADraggedWheelIsNeverLate) {
  for (int cycle = 0; cycle < 50; ++cycle) {
    control(velocityOf(500), Velocity(900));
  }
  EXPECT_EQ(controller.applied(), Tension(0));
  EXPECT_FALSE(controller.reversalLate());
}

/// @brief A demand of 499 mV in the direction opposite to the orientation never causes a late
/// reversal. The same is true without a demand.
/// @verifies FR-222
TEST_F(WheelControllerTest, FR222_SlightDemandIsNeverLate) {
  for (int cycle = 0; cycle < 50; ++cycle) {
    control(tensionOf(cycle % 2 == 0 ? -499 : 0), Velocity(900));
  }
  EXPECT_FALSE(controller.reversalLate());
}

/// @brief In the cycle of an overcurrent trip, no voltage is applied. The next control step begins
/// without memory.
/// @verifies FR-89
TEST_F(WheelControllerTest, FR89_DriverOffAppliesNothing) {
  for (int cycle = 0; cycle < 5; ++cycle) {
    control(velocityOf(1500), Velocity(100));
  }
  controller.driverOff();
  EXPECT_EQ(controller.applied(), std::nullopt);
  EXPECT_EQ(output(), Tension(0));
  control(velocityOf(1500), Velocity(100));
  EXPECT_EQ(controller.applied(), Tension(7854));
}

/// @brief After an overcurrent trip, control begins without the voltage that the load of the wheel
/// needed before.
/// @verifies FR-89
/// @verifies FR-301
TEST_F(WheelControllerTest, FR89_DriverOffClearsTheMemory) {
  for (int cycle = 0; cycle < 5; ++cycle) {
    control(velocityOf(1000), Velocity(100), Current(3500));
  }
  ASSERT_GT(controller.applied(), Tension(6000));
  controller.driverOff();
  control(velocityOf(1000), Velocity(100), Current(3500));
  EXPECT_EQ(controller.applied(), Tension(5236));
}

/// @brief If two calls of driverOff() are more than 50 ms apart, they belong to two cycles. The
/// second call then switches the driver on without voltage, and the motor brakes. If the calls are
/// at most 50 ms apart, the driver stays off.
/// @verifies FR-221
TEST_F(WheelControllerTest, FR221_CallsOfTwoCycles) {
  for (const int distance : {50, 51}) {
    ControlledWheel one;
    one.control(tensionOf(5000));
    one.wheel.cutOff().execute();
    one.controller.driverOff();
    one.time.advance(milliseconds(distance));
    one.controller.driverOff();
    EXPECT_EQ(one.enable.isOn(), distance > 50) << distance;
  }
}

/// @brief After an overcurrent trip, the voltage rises from 0.
/// @verifies FR-81
/// @verifies FR-89
TEST_F(WheelControllerTest, FR81_RiseBeginsAtZeroAfterATrip) {
  control(tensionOf(12000));
  control(tensionOf(24000));
  ASSERT_EQ(controller.applied(), Tension(24000));
  controller.driverOff();
  control(tensionOf(24000));
  EXPECT_EQ(controller.applied(), Tension(12000));
}

}  // namespace
}  // namespace wr::test
