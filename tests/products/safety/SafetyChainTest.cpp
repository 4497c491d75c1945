#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "main_control/SpySystem.hpp"
#include "safety/Arming.hpp"
#include "safety/ProtectiveStop.hpp"
#include "safety/RobotStage.hpp"
#include "safety/SafeSystem.hpp"
#include "safety/SetPointRamp.hpp"
#include "sensing/FakeEdgeInput.hpp"

namespace wr::test {
namespace {

/// The stages of the safety functions. The last stage is the robot with one spy control system,
/// which records the orders that it receives.
class SafetyChain : public testing::Test {
 protected:
  SafetyChain() {
    robot.add(spy);
    spy.whole = true;
    for (WheelMeasurements& wheel : spy.measured.wheels) {
      wheel.velocity = Velocity();
      wheel.current = Current();
    }
  }

  static SetPoints alike(std::int16_t value, WheelQuantity quantity = WheelQuantity::Velocity) {
    SetPoints setPoints;
    setPoints.wheels.fill({.quantity = quantity, .value = value});
    return setPoints;
  }

  void order(OrderStage& system, const SetPoints& setPoints) {
    spy.calls.clear();
    system.follow(setPoints, ++number);
  }

  void hold(OrderStage& system) {
    spy.calls.clear();
    system.stand(++number);
  }

  void acknowledge(OrderStage& system) {
    spy.calls.clear();
    system.recover(++number);
  }

  static RetainedProtection& memoryAtPowerOn(RetainedProtection& memory) {
    memory.begin({.cause = ResetCause::PowerOn});
    return memory;
  }

  static Protection protection(const OrderStage& system) {
    Measurements measurements;
    Outputs outputs;
    system.collect(measurements, outputs);
    return measurements.protection;
  }

  std::uint32_t number = 0;
  SpySystem spy;
  RobotStage robot;
};

class RobotOfPool : public SafetyChain {
 protected:
  RobotOfPool() { robot.add(second); }

  SpySystem second;
};

/// @brief The robot is one control system that contains the other control systems. The robot passes
/// each order and the number of the cycle to every control system. The robot has completed a
/// cycle when all control systems have completed this cycle.
/// @verifies FR-293
TEST_F(RobotOfPool, FR293_EachOrderReachesEveryControlSystem) {
  order(robot, alike(123));
  EXPECT_EQ(spy.calls, kControlled);
  EXPECT_EQ(second.calls, kControlled);
  EXPECT_EQ(second.applied, alike(123));
  EXPECT_EQ(second.cycle, number);
  EXPECT_TRUE(robot.completed(number));
  second.completes = false;
  EXPECT_FALSE(robot.completed(number));
  second.calls.clear();
  hold(robot);
  EXPECT_EQ(second.calls, kHeld);
  second.calls.clear();
  acknowledge(robot);
  EXPECT_EQ(second.calls, kAcknowledged);
}

/// @brief The robot with safety functions is one control system. Each order to this control system
/// reaches the first stage of the safety functions.
/// @verifies FR-293
TEST_F(RobotOfPool, FR293_TheRobotIsOneControlSystem) {
  SafeSystem whole(robot);
  whole.control(alike(7), 1);
  EXPECT_EQ(second.calls, kControlled);
  EXPECT_EQ(second.applied, alike(7));
  EXPECT_TRUE(whole.completed(1));
  second.calls.clear();
  whole.hold(2);
  EXPECT_EQ(second.calls, kHeld);
  second.calls.clear();
  whole.acknowledge(3);
  EXPECT_EQ(second.calls, kAcknowledged);
  spy.measured.steering = Angle(55);
  Measurements measurements;
  Outputs outputs;
  whole.collect(measurements, outputs);
  EXPECT_EQ(measurements.steering, Angle(55));
}

class ProtectiveStopTest : public SafetyChain {
 protected:
  FakeEdgeInput contact;
  ContactWatch watch{contact};
  RetainedProtection::Cells cells{};
  RetainedProtection memory{cells};
  ProtectiveStop stop{robot, watch, memoryAtPowerOn(memory)};

  ProtectiveStopTest() { contact.set(false); }

  /// Checks that the robot is held in each of the next 20 cycles, although these cycles have orders
  /// that move the wheels.
  void expectLatched(StopCause cause, std::uint8_t wheel) {
    for (int cycles = 0; cycles < 20; ++cycles) {
      order(stop, alike(100));
      EXPECT_EQ(spy.calls, kHeld);
      EXPECT_EQ(protection(stop).inhibit, Inhibit::ProtectiveStop);
      EXPECT_EQ(protection(stop).cause, cause);
      EXPECT_EQ(protection(stop).wheel, wheel);
    }
  }
};

/// @brief Without a fault, set-points are forwarded, and the report contains no cause of a stop.
/// @verifies FR-270
/// @verifies FR-281
TEST_F(ProtectiveStopTest, FR270_SetPointsPassWithoutAFault) {
  for (int cycles = 0; cycles < 20; ++cycles) {
    order(stop, alike(0));
    EXPECT_EQ(spy.calls, kControlled);
  }
  EXPECT_EQ(protection(stop), Protection{});
}

/// @brief A fault of one wheel holds all control systems in the cycle of the fault and in later
/// cycles. They are still held after the end of the fault, and after a hold.
/// @verifies FR-270
/// @verifies FR-281
TEST_F(ProtectiveStopTest, FR270_AFaultHoldsInItsCycleAndAfterwards) {
  order(stop, alike(100));
  spy.measured.wheels[2].cutOff = true;
  order(stop, alike(100));
  EXPECT_EQ(spy.calls, (std::vector<std::string>{"measure", "apply", "activate", "measure", "halt",
                                                 "activate"}));
  expectLatched(StopCause::Overcurrent, 2);
  spy.measured.wheels[2].cutOff = false;
  hold(stop);
  expectLatched(StopCause::Overcurrent, 2);
}

/// @brief A fault of a wheel or of the steering causes a protective stop, even while the robot is
/// held.
/// @verifies FR-272
/// @verifies FR-273
/// @verifies FR-274
TEST_F(ProtectiveStopTest, FR272_FR274_AHeldRobotIsSupervised) {
  const Measurements faultless = spy.measured;
  const auto causes = [&](StopCause cause, std::uint8_t wheel) {
    hold(stop);
    spy.measured = faultless;
    hold(stop);
    EXPECT_EQ(protection(stop).cause, cause);
    EXPECT_EQ(protection(stop).wheel, wheel);
    acknowledge(stop);
    hold(stop);
    EXPECT_EQ(protection(stop).cause, StopCause::None);
  };
  spy.measured.wheels[2].cutOff = true;
  causes(StopCause::Overcurrent, 2);
  spy.measured.wheels[1].blind = true;
  causes(StopCause::NoMotion, 1);
  spy.measured.wheels[3].velocity = Velocity(-3301);
  causes(StopCause::Overspeed, 3);
  spy.measured.steeringState = SteeringState::Fault;
  causes(StopCause::SteeringFault, Protection::kNoWheel);
}

/// @brief An open contact of the emergency-stop circuit causes a protective stop, even while the
/// robot is held.
/// @verifies FR-271
TEST_F(ProtectiveStopTest, FR271_TheEmergencyStopIsACause) {
  contact.set(true);
  hold(stop);
  contact.set(false);
  expectLatched(StopCause::EmergencyStop, Protection::kNoWheel);
}

/// @brief After a reset, the protective stop is latched again with its cause and its wheel. The
/// stop lasts until an acknowledgement releases it.
/// @verifies FR-291
TEST_F(ProtectiveStopTest, FR291_AProtectiveStopOutlivesAReset) {
  memory.save({.cause = StopCause::Overspeed, .wheel = 2});
  memory.begin({.cause = ResetCause::Watchdog});
  ProtectiveStop afterReset(robot, watch, memory);
  order(afterReset, alike(1000));
  EXPECT_EQ(spy.calls, kHeld);
  EXPECT_EQ(protection(afterReset).cause, StopCause::Overspeed);
  EXPECT_EQ(protection(afterReset).wheel, 2);
  acknowledge(afterReset);
  memory.begin({.cause = ResetCause::Watchdog});
  ProtectiveStop released(robot, watch, memory);
  EXPECT_EQ(protection(released).cause, StopCause::None);
}

/// @brief The first cause of a protective stop is stored in the cycle that latches this cause.
/// @verifies FR-291
TEST_F(ProtectiveStopTest, FR291_TheCauseIsStored) {
  EXPECT_EQ(memory.stored(), RetainedProtection::Stop());
  contact.set(true);
  order(stop, alike(1000));
  EXPECT_EQ(memory.stored().cause, StopCause::EmergencyStop);
  EXPECT_EQ(memory.stored().wheel, Protection::kNoWheel);
}

/// @brief Power-on releases the protective stop. After any other reset, an empty, erased or changed
/// memory counts as a stored protective stop.
/// @verifies FR-291
TEST(RetainedProtectionTest, FR291_DoubtfulMemoryIsAProtectiveStop) {
  RetainedProtection::Cells cells{};
  RetainedProtection memory(cells);
  memory.begin({.cause = ResetCause::Pin});
  EXPECT_EQ(memory.stored().cause, StopCause::MissingMeasurement);
  cells = {.value = 0xFFFF'FFFF, .check = 0xFFFF'FFFF};
  EXPECT_EQ(memory.stored().cause, StopCause::MissingMeasurement);
  memory.begin({.cause = ResetCause::PowerOn});
  EXPECT_EQ(memory.stored().cause, StopCause::None);
  const RetainedProtection::Cells whole = cells;
  for (unsigned bit = 0; bit < 32; ++bit) {
    cells = {.value = whole.value ^ (1U << bit), .check = whole.check};
    EXPECT_EQ(memory.stored().cause, StopCause::MissingMeasurement) << bit;
    cells = {.value = whole.value, .check = whole.check ^ (1U << bit)};
    EXPECT_EQ(memory.stored().cause, StopCause::MissingMeasurement) << bit;
  }
}

/// @brief After each reset except power-on, the stored protective stop is unchanged.
/// @verifies FR-291
TEST(RetainedProtectionTest, FR291_OnlyPowerOnReleases) {
  for (const ResetCause cause : {ResetCause::Unknown, ResetCause::PowerOn, ResetCause::LowVoltage,
                                 ResetCause::Pin, ResetCause::Watchdog, ResetCause::ClockLost,
                                 ResetCause::Lockup, ResetCause::Software, ResetCause::Debugger}) {
    RetainedProtection::Cells cells{};
    RetainedProtection memory(cells);
    const RetainedProtection::Stop stop{.cause = StopCause::Overspeed, .wheel = 2};
    memory.save(stop);
    memory.begin({.cause = cause});
    EXPECT_EQ(memory.stored() == stop, cause != ResetCause::PowerOn) << static_cast<int>(cause);
  }
}

/// @brief The memory returns the stored cause. If a wheel was stored with the cause, the memory
/// also returns this wheel. If the stored number belongs to no wheel, the memory counts as a stored
/// protective stop.
/// @verifies FR-291
TEST(RetainedProtectionTest, FR291_EachCauseAndWheelIsStored) {
  RetainedProtection::Cells cells{};
  RetainedProtection memory(cells);
  for (const std::uint8_t wheel : {std::uint8_t{0}, std::uint8_t{3}, Protection::kNoWheel}) {
    for (const StopCause cause : {StopCause::Overspeed, StopCause::ClockLost}) {
      const RetainedProtection::Stop stop{.cause = cause, .wheel = wheel};
      memory.save(stop);
      EXPECT_EQ(memory.stored(), stop);
    }
  }
  memory.save({.cause = StopCause::Overspeed, .wheel = 4});
  EXPECT_EQ(memory.stored(), RetainedProtection::Stop{.cause = StopCause::MissingMeasurement});
}

/// @brief A loss of the external clock latches a protective stop. A start at which this clock fails
/// also latches a protective stop. An earlier cause is not overwritten.
/// @verifies FR-291
TEST(RetainedProtectionTest, FR291_ALossOfTheClockIsAProtectiveStop) {
  RetainedProtection::Cells cells{};
  RetainedProtection memory(cells);
  for (const StartRecord& start :
       {StartRecord{.cause = ResetCause::ClockLost},
        StartRecord{.cause = ResetCause::Watchdog, .fault = FaultKind::ClockFailed}}) {
    memory.begin({.cause = ResetCause::PowerOn});
    EXPECT_EQ(memory.stored(), RetainedProtection::Stop());
    memory.begin(start);
    EXPECT_EQ(memory.stored(), RetainedProtection::Stop{.cause = StopCause::ClockLost});
  }
  memory.save({.cause = StopCause::NoMotion, .wheel = 3});
  memory.begin({.cause = ResetCause::ClockLost});
  EXPECT_EQ(memory.stored().cause, StopCause::NoMotion);
  EXPECT_EQ(memory.stored().wheel, 3);
}

/// @brief If the contact of the emergency stop is open for three ticks between two cycles, the
/// robot stops in the next cycle. If this contact is open for two ticks, the robot does not stop.
/// @verifies FR-271
TEST_F(ProtectiveStopTest, FR271_AShortOpeningIsLatched) {
  for (const int ticks : {2, 2, 3}) {
    EXPECT_EQ(protection(stop).cause, StopCause::None);
    contact.set(true);
    for (int tick = 0; tick < ticks; ++tick) {
      watch.sample();
    }
    contact.set(false);
    watch.sample();
    order(stop, alike(1000));
  }
  EXPECT_EQ(protection(stop).cause, StopCause::EmergencyStop);
}

class ContactWatchTest : public testing::Test {
 protected:
  void ticks(bool open, int count) {
    contact.set(open);
    for (int tick = 0; tick < count; ++tick) {
      watch.sample();
    }
  }

  FakeEdgeInput contact;
  ContactWatch watch{contact};
};

/// @brief The watch of the emergency stop reports an opening in each cycle that finds the contact
/// open. The watch does not report this opening again after the contact has closed.
/// @verifies FR-271
TEST_F(ContactWatchTest, FR271_ALongOpeningIsReportedInEachCycle) {
  for (int cycle = 0; cycle < 3; ++cycle) {
    ticks(true, 100);
    EXPECT_TRUE(watch.opened());
  }
  ticks(true, 50);
  ticks(false, 50);
  EXPECT_FALSE(watch.opened());
}

/// @brief An opening between two cycles is reported in the second of these cycles, and not in later
/// cycles. A later cycle reports a new opening. If a cycle finds the contact open, the next cycle
/// also reports a second opening that began and ended between these two cycles.
/// @verifies FR-271
TEST_F(ContactWatchTest, FR271_EachOpeningBetweenTwoCyclesIsReported) {
  ticks(true, 3);
  ticks(false, 1);
  EXPECT_TRUE(watch.opened());
  EXPECT_FALSE(watch.opened());
  ticks(true, 1);
  EXPECT_TRUE(watch.opened());
  ticks(true, 5);
  ticks(false, 1);
  ticks(true, 3);
  ticks(false, 1);
  EXPECT_TRUE(watch.opened());
  EXPECT_FALSE(watch.opened());
}

/// @brief The contact closes just before a cycle, and opens again before the next tick. The watch
/// reports the second opening, although no tick found the contact closed.
/// @verifies FR-271
TEST_F(ContactWatchTest, FR271_ACycleThatFindsTheContactClosedEndsAnOpening) {
  ticks(true, 5);
  EXPECT_TRUE(watch.opened());
  contact.set(false);
  EXPECT_FALSE(watch.opened());
  ticks(true, 3);
  contact.set(false);
  EXPECT_TRUE(watch.opened());
}

/// @brief When the contact of the emergency stop is closed again, an acknowledgement releases the
/// protective stop that the opening of this contact caused. This opening causes no second stop.
/// @verifies FR-291
TEST_F(ProtectiveStopTest, FR291_AnOpeningBeforeTheAcknowledgementEnds) {
  contact.set(true);
  for (int tick = 0; tick < 300; ++tick) {
    watch.sample();
    if (tick % 100 == 99) {
      order(stop, alike(1000));
    }
  }
  contact.set(false);
  watch.sample();
  acknowledge(stop);
  EXPECT_EQ(protection(stop).cause, StopCause::None);
  order(stop, alike(1000));
  EXPECT_EQ(protection(stop).cause, StopCause::None);
}

/// @brief A short opening of the contact occurs before a cycle that reads an acknowledgement. The
/// cycle still latches the protective stop of this opening. The next acknowledgement releases this
/// stop.
/// @verifies FR-271
/// @verifies FR-291
TEST_F(ProtectiveStopTest, FR271_AnOpeningThatCausedNoStopIsNotAcknowledged) {
  contact.set(true);
  for (int tick = 0; tick < 3; ++tick) {
    watch.sample();
  }
  contact.set(false);
  watch.sample();
  acknowledge(stop);
  EXPECT_EQ(protection(stop).cause, StopCause::EmergencyStop);
  acknowledge(stop);
  EXPECT_EQ(protection(stop).cause, StopCause::None);
}

/// @brief While a protective stop is latched, the contact opens again and closes again between two
/// cycles. The next cycle reads an acknowledgement. This acknowledgement does not release the
/// protective stop. The next acknowledgement releases it.
/// @verifies FR-271
/// @verifies FR-291
TEST_F(ProtectiveStopTest, FR271_AShortOpeningDuringAStopIsNotAcknowledged) {
  const auto openFor = [&](int ticks) {
    contact.set(true);
    for (int tick = 0; tick < ticks; ++tick) {
      watch.sample();
    }
    contact.set(false);
    watch.sample();
  };
  for (const bool follows : {true, false}) {
    openFor(3);
    for (int cycles = 0; cycles < 3; ++cycles) {
      if (follows) {
        order(stop, alike(1000));
      } else {
        hold(stop);
      }
    }
    openFor(3);
    acknowledge(stop);
    EXPECT_EQ(protection(stop).cause, StopCause::EmergencyStop) << follows;
    EXPECT_EQ(memory.stored().cause, StopCause::EmergencyStop) << follows;
    acknowledge(stop);
    EXPECT_EQ(protection(stop).cause, StopCause::None) << follows;
  }
}

/// @brief While a protective stop is latched, the contact opens for three ticks and closes again.
/// The next cycle reads no acknowledgement, and its report shows the protective stop. After this
/// cycle, an acknowledgement releases the protective stop. This is true for a cycle with set-points
/// and for a hold.
/// @verifies FR-291
TEST_F(ProtectiveStopTest, FR291_AnOpeningDuringAStopIsAcknowledgedAfterItsReport) {
  for (const bool follows : {true, false}) {
    for (int opening = 0; opening < 2; ++opening) {
      contact.set(true);
      for (int tick = 0; tick < 3; ++tick) {
        watch.sample();
      }
      contact.set(false);
      watch.sample();
      if (follows) {
        order(stop, alike(1000));
      } else {
        hold(stop);
      }
      EXPECT_EQ(protection(stop).cause, StopCause::EmergencyStop) << follows;
    }
    acknowledge(stop);
    EXPECT_EQ(protection(stop).cause, StopCause::None) << follows;
  }
}

/// @brief A cycle finds the contact open. Before the next cycle, the contact closes, opens for
/// three ticks and closes again. The next cycle reads an acknowledgement. This acknowledgement does
/// not release the protective stop, because nobody can have seen the second opening. The next
/// acknowledgement releases it.
/// @verifies FR-271
/// @verifies FR-291
TEST_F(ProtectiveStopTest, FR271_ASecondOpeningIsNotAcknowledged) {
  contact.set(true);
  hold(stop);
  for (const bool open : {true, false, true, true, true, false}) {
    contact.set(open);
    watch.sample();
  }
  acknowledge(stop);
  expectLatched(StopCause::EmergencyStop, Protection::kNoWheel);
  acknowledge(stop);
  EXPECT_EQ(protection(stop).cause, StopCause::None);
}

/// @brief An acknowledgement does not release the protective stop while the contact of the
/// emergency stop is open.
/// @verifies FR-271
/// @verifies FR-291
TEST_F(ProtectiveStopTest, FR271_AnOpenContactCannotBeAcknowledged) {
  contact.set(true);
  hold(stop);
  acknowledge(stop);
  EXPECT_EQ(spy.calls, kAcknowledged);
  expectLatched(StopCause::EmergencyStop, Protection::kNoWheel);
  contact.set(false);
  acknowledge(stop);
  order(stop, alike(0));
  EXPECT_EQ(spy.calls, kControlled);
}

/// @brief The robot stops if a wheel moves less than the other wheels. It also stops if a wheel
/// draws 12 A for 1 s. A hold restarts the comparison of the wheels.
/// @verifies FR-297
/// @verifies FR-298
TEST_F(ProtectiveStopTest, FR297_FR298_TheWheelsAreCompared) {
  int edges = 0;
  const auto drive = [&](int cycles) {
    for (int left = cycles; left > 0; --left) {
      edges += 10;
      for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
        spy.measured.wheels[wheel].position = HallCount(wheel == 2 ? 1 : edges);
        spy.measured.wheels[wheel].current = Current(left % 2);
      }
      order(stop, alike(100));
    }
  };
  drive(4);
  hold(stop);
  drive(4);
  EXPECT_EQ(protection(stop).cause, StopCause::None);
  drive(2);
  expectLatched(StopCause::NoMotion, 2);
  acknowledge(stop);
  for (int cycles = 0; cycles < 10; ++cycles) {
    EXPECT_EQ(protection(stop).cause, StopCause::None);
    spy.measured.wheels[1].current = Current(12000 + cycles);
    order(stop, alike(100));
  }
  expectLatched(StopCause::Overcurrent, 1);
}

/// @brief A hold is forwarded to the control systems.
/// @verifies FR-270
TEST_F(ProtectiveStopTest, FR270_AHoldPasses) {
  hold(stop);
  EXPECT_EQ(spy.calls, kHeld);
}

/// @brief An acknowledgement restarts the supervision of each wheel. The counts of all faults then
/// begin at 0 again.
/// @verifies FR-291
TEST_F(ProtectiveStopTest, FR291_AnAcknowledgementRestartsTheSupervision) {
  const auto missing = [&] {
    for (WheelMeasurements& wheel : spy.measured.wheels) {
      wheel.velocity.reset();
    }
    order(stop, alike(0));
  };
  order(stop, alike(0));
  missing();
  spy.measured.wheels[0].cutOff = true;
  missing();
  EXPECT_EQ(protection(stop).cause, StopCause::Overcurrent);
  spy.measured.wheels[0].cutOff = false;
  acknowledge(stop);
  missing();
  EXPECT_EQ(protection(stop).cause, StopCause::None);
}

/// @brief A fault of the steering causes a protective stop.
/// @verifies FR-272
TEST_F(ProtectiveStopTest, FR272_AFaultOfTheSteeringIsACause) {
  order(stop, alike(0));
  spy.measured.steeringState = SteeringState::Fault;
  order(stop, alike(0));
  spy.measured.steeringState = SteeringState::Holding;
  expectLatched(StopCause::SteeringFault, Protection::kNoWheel);
}

/// @brief Only an acknowledgement releases a protective stop. The acknowledgement reaches the
/// control systems. If the fault is still present, it causes the next protective stop.
/// @verifies FR-291
TEST_F(ProtectiveStopTest, FR291_AnAcknowledgementReleases) {
  spy.measured.wheels[1].blind = true;
  order(stop, alike(0));
  acknowledge(stop);
  EXPECT_EQ(spy.calls, kAcknowledged);
  EXPECT_EQ(protection(stop), Protection{});
  order(stop, alike(0));
  expectLatched(StopCause::NoMotion, 1);
  spy.measured.wheels[1].blind = false;
  acknowledge(stop);
  order(stop, alike(50));
  EXPECT_EQ(spy.calls, kControlled);
  EXPECT_EQ(protection(stop), Protection{});
}

class ArmingTest : public SafetyChain {
 protected:
  Arming arming{robot};

  void neutral(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      order(arming, alike(0));
      EXPECT_EQ(spy.calls, kHeld);
    }
  }
};

/// @brief After the start, orders that are not neutral move nothing.
/// @verifies FR-280
TEST_F(ArmingTest, FR280_NothingMovesUnarmed) {
  for (int cycles = 0; cycles < 50; ++cycles) {
    order(arming, alike(1));
    EXPECT_EQ(spy.calls, kHeld);
    EXPECT_FALSE(protection(arming).armed);
    EXPECT_EQ(protection(arming).inhibit, Inhibit::NotArmed);
  }
}

/// @brief Orders are forwarded after five cycles of 100 ms with neutral orders. After only four
/// such cycles, orders are not forwarded. An order that is not neutral restarts the count.
/// @verifies FR-280
/// @verifies FR-281
TEST_F(ArmingTest, FR280_NeutralOrdersOfHalfASecondArm) {
  neutral(4);
  order(arming, alike(1));
  EXPECT_EQ(spy.calls, kHeld);
  neutral(5);
  EXPECT_TRUE(protection(arming).armed);
  EXPECT_EQ(protection(arming).inhibit, Inhibit::None);
  order(arming, alike(1));
  EXPECT_EQ(spy.calls, kControlled);
}

/// @brief A neutral order is counted only once, even if it stays in force.
/// @verifies FR-280
TEST_F(ArmingTest, FR280_ANeutralOrderCountsOnce) {
  SetPoints old = alike(0);
  old.repeated = true;
  for (int orders = 0; orders < 5; ++orders) {
    EXPECT_FALSE(protection(arming).armed) << orders << " orders";
    neutral(1);
    for (int cycles = 0; orders < 4 && cycles < 4; ++cycles) {
      order(arming, old);
      EXPECT_EQ(spy.calls, kHeld);
      EXPECT_FALSE(protection(arming).armed) << orders << " orders";
    }
  }
  EXPECT_TRUE(protection(arming).armed);
}

/// @brief An order is neutral only when all its wheel values are 0, in any quantity.
/// @verifies FR-280
TEST_F(ArmingTest, FR280_EveryWheelHasToBeNeutral) {
  for (const WheelQuantity quantity :
       {WheelQuantity::Velocity, WheelQuantity::Tension, WheelQuantity::Current}) {
    neutral(4);
    SetPoints one = alike(0);
    one.wheels[3] = {.quantity = quantity, .value = -1};
    order(arming, one);
    EXPECT_EQ(spy.calls, kHeld);
    EXPECT_FALSE(protection(arming).armed);
  }
}

/// @brief A hold disarms the robot. An acknowledgement also disarms the robot.
/// @verifies FR-280
TEST_F(ArmingTest, FR280_AHoldAndAnAcknowledgementDisarm) {
  neutral(5);
  hold(arming);
  EXPECT_EQ(spy.calls, kHeld);
  order(arming, alike(1));
  EXPECT_EQ(spy.calls, kHeld);
  neutral(5);
  acknowledge(arming);
  EXPECT_EQ(spy.calls, kAcknowledged);
  order(arming, alike(1));
  EXPECT_EQ(spy.calls, kHeld);
}

/// @brief After a hold and after an acknowledgement, the count of neutral orders begins at 0.
/// @verifies FR-280
TEST_F(ArmingTest, FR280_AHoldAndAnAcknowledgementRestartTheCount) {
  neutral(4);
  hold(arming);
  neutral(4);
  EXPECT_FALSE(protection(arming).armed);
  acknowledge(arming);
  neutral(4);
  EXPECT_FALSE(protection(arming).armed);
  neutral(1);
  EXPECT_TRUE(protection(arming).armed);
}

/// @brief While a protective stop is latched, the robot is not armed, and the cause stays in the
/// report.
/// @verifies FR-281
TEST_F(ArmingTest, FR281_AProtectiveStopIsReportedFirst) {
  FakeEdgeInput contact;
  contact.set(true);
  ContactWatch watch(contact);
  RetainedProtection::Cells cells{};
  RetainedProtection memory(cells);
  ProtectiveStop stop(robot, watch, memoryAtPowerOn(memory));
  Arming outer(stop);
  for (int cycles = 0; cycles < 10; ++cycles) {
    order(outer, alike(0));
    EXPECT_EQ(protection(outer).inhibit, Inhibit::ProtectiveStop);
    EXPECT_FALSE(protection(outer).armed);
  }
}

class SetPointRampTest : public SafetyChain {
 protected:
  SetPointRamp ramp{robot};

  int first() const { return spy.applied.wheels[0].value; }
};

/// @brief The set-point follows orders of 300 rpm, -300 rpm and 0 rpm with at most 0.5 m/s^2. A
/// velocity of 300 rpm is 0.85 m/s. The set-point needs 18 + 35 + 18 cycles to reach the three
/// ordered values in sequence.
/// @verifies FR-282
TEST_F(SetPointRampTest, FR282_AccelerationIsAtMostHalfAMetrePerSecondSquared) {
  constexpr double kMetresPerSecond = 0.85 / 3000;
  int before = 0;
  int cycles = 0;
  for (const int target : {3000, -3000, 0}) {
    do {
      order(ramp, alike(static_cast<std::int16_t>(target)));
      const double change = std::abs(first() - before) * kMetresPerSecond;
      EXPECT_LE(change, 0.5 * 0.1);
      before = first();
      ++cycles;
    } while (first() != target && cycles < 1000);
  }
  EXPECT_EQ(cycles, 18 + 35 + 18);
}

/// @brief A change of a set-point by up to 17.6 rpm is applied in one cycle. A change by 17.7 rpm
/// needs more cycles.
/// @verifies FR-282
TEST_F(SetPointRampTest, FR282_SmallChangesPass) {
  order(ramp, alike(176));
  EXPECT_EQ(first(), 176);
  order(ramp, alike(176 + 177));
  EXPECT_EQ(first(), 176 + 176);
}

/// @brief For each wheel: if only the set-point of this wheel changes by too much, this change is
/// limited.
/// @verifies FR-282
TEST_F(SetPointRampTest, FR282_EachWheelHasItsRamp) {
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    acknowledge(ramp);
    SetPoints one = alike(0);
    one.wheels[wheel].value = 177;
    order(ramp, one);
    EXPECT_EQ(spy.applied.wheels[wheel].value, 176) << wheel;
  }
}

/// @brief A set-point of voltage or current for one wheel does not change the ramp of the velocity
/// of another wheel.
/// @verifies FR-282
TEST_F(SetPointRampTest, FR282_OtherQuantitiesDoNotChangeTheRamp) {
  for (const WheelQuantity quantity : {WheelQuantity::Tension, WheelQuantity::Current}) {
    for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
      acknowledge(ramp);
      SetPoints mixed = alike(176);
      mixed.wheels[wheel] = {.quantity = quantity, .value = 1000};
      order(ramp, mixed);
      for (std::size_t other = 0; other < kWheelCount; ++other) {
        EXPECT_EQ(spy.applied.wheels[other].value, other == wheel ? 1000 : 176) << other;
      }
    }
  }
}

/// @brief If the set-point of one wheel changes by too much, the changes of all set-points are
/// reduced by the same factor.
/// @verifies FR-282
TEST_F(SetPointRampTest, FR282_OneFactorForAllWheels) {
  SetPoints curve = alike(1000);
  curve.wheels[0].value = 500;
  curve.wheels[2].value = -250;
  order(ramp, curve);
  EXPECT_EQ(spy.applied.wheels[1].value, 176);
  EXPECT_EQ(spy.applied.wheels[0].value, 88);
  EXPECT_EQ(spy.applied.wheels[2].value, -44);
}

/// @brief While no wheel is too fast, set-points of current are not changed. The ramp of a later
/// set-point of velocity begins at the velocity with the smaller magnitude: the measured velocity,
/// or the velocity of an unloaded wheel at the present voltage. If these velocities have opposite
/// directions, the ramp begins at 0.
/// @verifies FR-282
TEST_F(SetPointRampTest, FR282_VelocityBeginsWithoutAJump) {
  struct Case {
    int velocity;  // [0.1 rpm]
    int volts;
    int begin;  // 5.236 V cause 100 rpm
  };
  for (const auto& [velocity, volts, begin] :
       {Case{900, 12, 900}, Case{2000, 5, 954}, Case{-2000, -5, -954}, Case{2000, -5, 0}}) {
    for (WheelMeasurements& wheel : spy.measured.wheels) {
      wheel.velocity = Velocity(velocity);
    }
    spy.outputs.tensions.fill(Tension(1000 * volts));
    for (int cycles = 0; cycles < 20; ++cycles) {  // until the reduction has ended
      order(ramp, alike(-10000, WheelQuantity::Current));
    }
    EXPECT_EQ(first(), -10000);
    order(ramp, alike(static_cast<std::int16_t>(begin + 100)));
    EXPECT_EQ(first(), begin + 100);
    order(ramp, alike(-10000, WheelQuantity::Current));
    order(ramp, alike(static_cast<std::int16_t>(begin + 1000)));
    EXPECT_EQ(first(), begin + 176);
  }
}

/// @brief The ramp of each wheel begins at the velocity and the voltage of this wheel.
/// @verifies FR-282
TEST_F(SetPointRampTest, FR282_EachWheelBeginsAtItsVoltage) {
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    spy.measured.wheels[wheel].velocity = Velocity(2000);
    spy.outputs.tensions[wheel] = Tension(5236 + 1000 * static_cast<int>(wheel));
  }
  for (int cycles = 0; cycles < 20; ++cycles) {  // until the reduction has ended
    order(ramp, alike(1000, WheelQuantity::Current));
  }
  SetPoints begin;
  const std::array<std::int16_t, kWheelCount> expected{1000, 1190, 1381, 1572};
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    begin.wheels[wheel] = {.quantity = WheelQuantity::Velocity, .value = expected[wheel]};
  }
  begin.wheels[0].value = 1176;
  order(ramp, begin);
  for (std::size_t wheel = 1; wheel < kWheelCount; ++wheel) {
    EXPECT_EQ(spy.applied.wheels[wheel].value, expected[wheel]) << wheel;
  }
  EXPECT_EQ(first(), 1176);
}

/// @brief The ramp of a set-point of voltage begins at the voltage of the same wheel.
/// @verifies FR-295
TEST_F(SetPointRampTest, FR295_EachWheelHasItsVoltage) {
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    spy.outputs.tensions[wheel] = Tension(2000 * static_cast<int>(wheel));
  }
  order(ramp, alike(24000, WheelQuantity::Tension));
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    EXPECT_EQ(spy.applied.wheels[wheel].value, 1000 + 2000 * static_cast<int>(wheel));
  }
}

/// @brief After orders of voltage, the ramp begins at the present voltage and the present velocity,
/// not at the values of the previous cycle. After a hold and after an acknowledgement, the ramp
/// begins at 0.
/// @verifies FR-282
TEST_F(SetPointRampTest, FR282_VelocityBeginsAtThePresentVoltage) {
  const auto present = [&](int velocity, int tension) {
    for (WheelMeasurements& wheel : spy.measured.wheels) {
      wheel.velocity = Velocity(velocity);
    }
    spy.outputs.tensions.fill(Tension(tension));
  };
  present(1500, 7200);
  order(ramp, alike(0, WheelQuantity::Tension));
  present(1000, 4800);
  order(ramp, alike(0));
  EXPECT_EQ(first(), 916 - 176);
  present(1000, 1000);
  order(ramp, alike(0));
  EXPECT_EQ(first(), 916 - 2 * 176);
  order(ramp, alike(0, WheelQuantity::Tension));
  hold(ramp);
  order(ramp, alike(0));
  EXPECT_EQ(first(), 0);
  order(ramp, alike(0, WheelQuantity::Tension));
  acknowledge(ramp);
  order(ramp, alike(0));
  EXPECT_EQ(first(), 0);
}

/// @brief In each cycle, a set-point of voltage differs from the voltage of the wheel by at most
/// 1.0 V in the direction away from 0, and by at most 2.4 V in the direction towards 0.
/// @verifies FR-295
TEST_F(SetPointRampTest, FR295_VoltagesFollowARamp) {
  const auto next = [&](int applied, int ordered) {
    spy.outputs.tensions.fill(Tension(applied));
    order(ramp, alike(static_cast<std::int16_t>(ordered), WheelQuantity::Tension));
    return first();
  };
  EXPECT_EQ(next(0, 24000), 1000);
  EXPECT_EQ(next(0, -24000), -1000);
  EXPECT_EQ(next(5000, 6000), 6000);
  EXPECT_EQ(next(5000, 6001), 6000);
  EXPECT_EQ(next(5000, 2600), 2600);
  EXPECT_EQ(next(5000, -24000), 2600);
  EXPECT_EQ(next(-5000, 24000), -2600);
  EXPECT_EQ(next(2400, -24000), 0);
  EXPECT_EQ(next(2000, -24000), -400);
  for (const int applied : {100, 500, 1400}) {  // on the other side of 0
    EXPECT_EQ(next(applied, -24000), -1000);
    EXPECT_EQ(next(-applied, 24000), 1000);
  }
  spy.outputs.tensions.fill(std::nullopt);
  order(ramp, alike(24000, WheelQuantity::Tension));
  EXPECT_EQ(first(), 1000);
}

/// @brief Up to a steering angle of 1 degree, the permitted velocity is 300 rpm. At 5 degrees, this
/// velocity is 260 rpm. At 32 degrees, it is 240 rpm. The greater of the ordered and the measured
/// angle determines the permitted velocity. All set-points are reduced by the same factor.
/// @verifies FR-294
TEST_F(SetPointRampTest, FR294_ACurveLowersTheVelocity) {
  struct Case {
    int ordered;   // [0.01 degree]
    int measured;  // [0.01 degree]
    int most;      // [0.1 rpm]
  };
  for (const auto& [ordered, measured, most] :
       {Case{0, 0, 3000}, Case{100, -100, 3000}, Case{300, 0, 2800}, Case{0, -300, 2800},
        Case{500, 0, 2600}, Case{0, 500, 2600}, Case{1850, 0, 2500}, Case{0, -3199, 2401},
        Case{-3200, 0, 2400}, Case{0, 3400, 2400}}) {
    SetPoints curve = alike(3000);
    curve.steering = Angle(ordered);
    curve.wheels[1].value = 1500;
    spy.measured.steering = Angle(measured);
    for (int cycles = 0; cycles < 40; ++cycles) {
      order(ramp, curve);
    }
    EXPECT_EQ(first(), most) << ordered << " " << measured;
    EXPECT_EQ(spy.applied.wheels[1].value, most / 2);
    curve.wheels[0].value = curve.wheels[2].value = curve.wheels[3].value = 2400;
    for (int cycles = 0; cycles < 40; ++cycles) {
      order(ramp, curve);
    }
    EXPECT_EQ(first(), 2400);
  }
}

/// @brief The set-points of all wheels fall while one wheel turns faster than the limit of 310.0
/// rpm, or will exceed this limit in two cycles. In each cycle, the set-points fall by 6 % of the
/// ordered values, but not below a tenth of these values. When no wheel is too fast, the set-points
/// rise again by 1 % of the ordered values per cycle. In a curve of 5 degrees, the limit is 270.0
/// rpm instead of 310.0 rpm.
/// @verifies FR-282
TEST_F(SetPointRampTest, FR282_AFastWheelLowersAllSetPoints) {
  constexpr int kFall = 60;  // 6 % of the ordered 1000 mA
  constexpr int kRise = 10;  // 1 %
  const auto at = [&](int velocity) {
    spy.measured.wheels[2].velocity = Velocity(velocity);
    order(ramp, alike(1000, WheelQuantity::Current));
    return first();
  };
  EXPECT_EQ(at(1000), 1000);
  EXPECT_EQ(at(1700), 1000);  // the wheel will have 310.0 rpm in two cycles
  EXPECT_EQ(at(1000), 1000);
  EXPECT_EQ(at(1701), 1000 - kFall);
  EXPECT_EQ(at(1701), 1000 - kFall + kRise);
  spy.measured.wheels[2].velocity = Velocity(3100);
  for (int cycles = 0; cycles < 10; ++cycles) {
    order(ramp, alike(1000, WheelQuantity::Current));
  }
  EXPECT_EQ(first(), 980);
  EXPECT_EQ(at(3101), 980 - kFall);
  EXPECT_EQ(at(3101), 980 - 2 * kFall);
  for (int cycles = 0; cycles < 50; ++cycles) {
    order(ramp, alike(1000, WheelQuantity::Current));
  }
  EXPECT_EQ(first(), 100);
  order(ramp, alike(2000));
  EXPECT_EQ(spy.applied.wheels[3].value, 176);
  spy.measured.steering = Angle(500);
  hold(ramp);
  EXPECT_EQ(at(2700), 1000);
  EXPECT_EQ(at(2700), 1000);
  EXPECT_EQ(at(2701), 1000 - kFall);
}

/// @brief The set-points fall if any single wheel is too fast, even while the velocity of this
/// wheel falls. If a wheel will reach but not exceed the limit in two cycles, the set-points do not
/// fall.
/// @verifies FR-282
TEST_F(SetPointRampTest, FR282_EachFastWheelCounts) {
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    acknowledge(ramp);
    for (const int velocity : {3200, 3101}) {
      spy.measured.wheels[wheel].velocity = Velocity(velocity);
      order(ramp, alike(1000, WheelQuantity::Current));
    }
    EXPECT_EQ(first(), 880) << wheel;
    acknowledge(ramp);
    for (const int velocity : {1000, 1700}) {
      spy.measured.wheels[wheel].velocity = Velocity(velocity);
      order(ramp, alike(1000, WheelQuantity::Current));
    }
    EXPECT_EQ(first(), 1000) << wheel;
    spy.measured.wheels[wheel].velocity = Velocity(1);
  }
}

/// @brief The set-points also fall if a wheel is too fast backwards. Set-points of voltage are
/// lowered in the same way as set-points of current.
/// @verifies FR-282
TEST_F(SetPointRampTest, FR282_AFastWheelLowersSetPointsBackwardsAndOfVoltage) {
  for (const int velocity : {-1000, -3101}) {
    spy.measured.wheels[2].velocity = Velocity(velocity);
    order(ramp, alike(1000, WheelQuantity::Current));
  }
  EXPECT_EQ(first(), 940);
  hold(ramp);
  spy.outputs.tensions.fill(Tension(10000));
  order(ramp, alike(10000, WheelQuantity::Tension));
  EXPECT_EQ(first(), 9400);
}

/// @brief An acknowledgement ends the reduction of the set-points.
/// @verifies FR-282
TEST_F(SetPointRampTest, FR282_AnAcknowledgementEndsTheReduction) {
  spy.measured.wheels[1].velocity = Velocity(3200);
  order(ramp, alike(1000, WheelQuantity::Current));
  EXPECT_EQ(first(), 940);
  spy.measured.wheels[1].velocity = Velocity(1000);
  acknowledge(ramp);
  order(ramp, alike(1000, WheelQuantity::Current));
  EXPECT_EQ(first(), 1000);
}

/// @brief After a hold and after an acknowledgement, the ramp begins at 0.
/// @verifies FR-282
TEST_F(SetPointRampTest, FR282_AHoldBeginsAtZero) {
  for (int cycles = 0; cycles < 10; ++cycles) {
    order(ramp, alike(1500));
  }
  hold(ramp);
  EXPECT_EQ(spy.calls, kHeld);
  order(ramp, alike(1500));
  EXPECT_EQ(first(), 176);
  acknowledge(ramp);
  EXPECT_EQ(spy.calls, kAcknowledged);
  order(ramp, alike(1500));
  EXPECT_EQ(first(), 176);
}

}  // namespace
}  // namespace wr::test
