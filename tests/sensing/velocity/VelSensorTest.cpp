#include "sensing/velocity/VelSensor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "functions/Function.hpp"
#include "sensing/velocity/TurningWheel.hpp"
#include "support/seed.hpp"

namespace wr::test {
namespace {

constexpr Microseconds kCycle = milliseconds(100);

class VelSensorTest : public testing::Test {
 protected:
  /// Turns the wheel for some cycles, with a measurement at the end of each cycle.
  void cycles(double rpm, int count) {
    for (int i = 0; i < count; ++i) {
      wheel.turn(rpm, kCycle);
      measured = wheel.measure();
    }
  }

  TurningWheel wheel;
  double measured = 0;  // the last measurement [0.1 rpm]
};

class VelocityAccuracy : public VelSensorTest, public testing::WithParamInterface<double> {};

/// @brief At a constant velocity, the error of each measurement is at most 0.2 % plus the rounding
/// to 0.1 rpm.
/// @verifies FR-120
TEST_P(VelocityAccuracy, FR120_EvenEdges) {
  const double rpm = GetParam();
  cycles(rpm, 10);
  for (int i = 0; i < 50; ++i) {
    cycles(rpm, 1);
    ASSERT_NEAR(measured, rpm * 10, std::abs(rpm) * 0.02 + 0.5) << "measurement " << i;
  }
}

/// @brief One sensor is displaced by 5 % of the distance between two edges. At 60 rpm or more, the
/// error of each measurement is at most 1 % plus the rounding to 0.1 rpm. At a lower velocity, the
/// error is at most 6 % plus this rounding.
/// @verifies FR-120
TEST_P(VelocityAccuracy, FR120_MisplacedSensor) {
  const double rpm = GetParam();
  wheel.misplacement = 0.05;
  cycles(rpm, 10);
  const double share = std::abs(rpm) < 60 ? 0.06 : 0.01;
  for (int i = 0; i < 50; ++i) {
    cycles(rpm, 1);
    ASSERT_NEAR(measured, rpm * 10, std::abs(rpm) * 10 * share + 0.5) << "measurement " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Rpm, VelocityAccuracy,
                         testing::Values(5, 7.3, 9.9, 10, 10.1, 20, 49.9, 60, 100, 150, 299.7, 300,
                                         -5, -20, -150, -300));

/// @brief Before the first edge, the velocity is 0.
/// @verifies FR-122
TEST_F(VelSensorTest, FR122_StandsAtStart) {
  cycles(0, 1);
  EXPECT_EQ(measured, 0);
}

/// @brief The velocity of the first edges after a standstill is computed over the time since the
/// previous measurement. The time since the last edge of an earlier movement has no effect.
/// @verifies FR-120
TEST_F(VelSensorTest, FR120_StartsFromStandstill) {
  cycles(100, 3);
  cycles(0, 100);
  ASSERT_EQ(measured, 0);
  cycles(50, 1);
  EXPECT_NEAR(measured, 500, 100);
  cycles(50, 1);
  EXPECT_NEAR(measured, 500, 1.5);
}

/// @brief In the first cycle with edges after a standstill, n edges count as n - 1/2 edges.
/// Therefore, the error until the next edge is at most 1.5 edges in a cycle, which are 15 rpm.
/// @verifies FR-120
TEST_F(VelSensorTest, FR120_StartsAtEachVelocity) {
  for (const double rpm :
       {5.1, 7.56, 9.4, 10.5, 19.58, 29.9, 69.0, 100.0, 149.9, 300.0, -7.56, -19.58}) {
    for (int phase = 0; phase < 10; ++phase) {
      TurningWheel one;
      one.turn(rpm < 0 ? -20 : 20, Microseconds(10'000 * phase));
      for (int cycle = 0; cycle < 10; ++cycle) {
        one.turn(0, kCycle);
        one.measure();
      }
      bool begun = false;
      for (int cycle = 0; cycle < 5; ++cycle) {
        one.turn(rpm, kCycle);
        const double value = one.measure();
        begun = begun || value != 0;
        if (begun) {
          ASSERT_NEAR(value, rpm * 10, 150)
              << rpm << " rpm, phase " << phase << ", cycle " << cycle;
        }
      }
      EXPECT_TRUE(begun) << rpm;
    }
  }
}

/// @brief After a standstill, one edge counts as half an edge, because the wheel may have been at
/// rest directly before this edge.
/// @verifies FR-120
TEST_F(VelSensorTest, FR120_FirstEdgeAfterStandstill) {
  for (const int direction : {1, -1}) {
    cycles(0, 6);
    wheel.turn(0, milliseconds(50));
    wheel.edge(direction);
    wheel.turn(0, milliseconds(50));
    EXPECT_EQ(wheel.measure() * direction, 50);
  }
}

/// @brief After a standstill, two edges count as one and a half edges.
/// @verifies FR-120
TEST_F(VelSensorTest, FR120_TwoEdgesAfterStandstill) {
  for (const int direction : {1, -1}) {
    cycles(0, 6);
    wheel.turn(0, milliseconds(50));
    wheel.edge(direction);
    wheel.turn(0, milliseconds(20));
    wheel.edge(direction);
    wheel.turn(0, milliseconds(30));
    EXPECT_EQ(wheel.measure() * direction, 150);
  }
}

/// @brief While there are no edges, the velocity is at most one edge divided by the time since the
/// last edge.
/// @verifies FR-122
TEST_F(VelSensorTest, FR122_FallsWhileEdgesStayAway) {
  for (const int direction : {1, -1}) {
    cycles(200 * direction, 10);
    for (int cycle = 1; cycle < 5; ++cycle) {
      cycles(0, 1);
      const double milliseconds = 100.0 * cycle;
      EXPECT_LE(measured * direction, 10000 / milliseconds + 0.5);
      EXPECT_GE(measured * direction, 10000 / (milliseconds + 5) - 0.5);
    }
    cycles(0, 1);
    EXPECT_EQ(measured, 0);
  }
}

/// @brief When a wheel slows down, its last edge is directly before or directly after a
/// measurement. The measured velocity is the same in both cases.
/// @verifies FR-122
TEST_F(VelSensorTest, FR122_AnEdgeAtTheMeasurementMakesNoStep) {
  for (const int direction : {1, -1}) {
    TurningWheel before;
    TurningWheel after;
    for (TurningWheel* each : {&before, &after}) {
      each->turn(25 * direction, milliseconds(1000));  // the last edge is then 20 ms old
      each->measure();
      each->turn(0, milliseconds(37));
      each->edge(direction);
      each->turn(0, milliseconds(62));
    }
    before.edge(direction);
    const double with = before.measure();
    const double without = after.measure();
    EXPECT_NEAR(with, without, 0.5);
    EXPECT_NEAR(with * direction, 2e4 / (20 + 37 + 62), 0.5);
  }
}

/// @brief Between two edges, the measured velocity of a slow wheel does not change, because no edge
/// is overdue.
/// @verifies FR-122
TEST_F(VelSensorTest, FR122_KeepsAVelocityThatNoEdgeDenies) {
  cycles(4, 20);
  for (int cycle = 0; cycle < 20; ++cycle) {
    cycles(4, 1);
    EXPECT_NEAR(measured, 40, 0.5);
  }
}

/// @brief A measurement directly after the previous measurement does not change the velocity.
/// @verifies FR-122
TEST_F(VelSensorTest, FR122_MeasuresTwiceInARow) {
  cycles(300, 3);
  const double before = measured;
  wheel.turn(0, Microseconds(1));
  EXPECT_EQ(wheel.measure(), before);
}

/// @brief The velocity becomes zero after 500 ms without an edge. It does not become zero earlier.
/// @verifies FR-122
TEST_F(VelSensorTest, FR122_StandsAfterHalfASecond) {
  wheel.turn(0, kCycle);
  wheel.measure();
  for (int i = 0; i < 4; ++i) {
    wheel.turn(0, milliseconds(10));
    wheel.edge(1);
  }
  EXPECT_GT(wheel.measure(), 0);
  wheel.turn(0, Microseconds(499999));
  EXPECT_EQ(wheel.measure(), 20);
  wheel.turn(0, Microseconds(1));
  EXPECT_EQ(wheel.measure(), 0);
}

/// @brief If a wheel changes its direction within a cycle, the measured velocity is the velocity of
/// the net movement.
/// @verifies FR-120
TEST_F(VelSensorTest, FR120_TurnsBack) {
  cycles(100, 5);
  wheel.turn(100, milliseconds(50));
  wheel.turn(-100, milliseconds(50));
  EXPECT_NEAR(wheel.measure(), 0, 110);
  cycles(-100, 1);
  EXPECT_NEAR(measured, -1000, 2.5);
}

/// @brief One lost edge removes two edges from one measurement. The next measurement is correct
/// again.
/// @verifies FR-120
/// @verifies FR-123
TEST_F(VelSensorTest, FR123_OneLostEdge) {
  cycles(100, 5);
  const HallCount before = wheel.velocity.position();
  EXPECT_EQ(wheel.velocity.rejectedEdges(), 0);
  wheel.turn(100, milliseconds(45));
  wheel.passed += 1;  // an edge passes without an interrupt
  wheel.turn(100, milliseconds(55));
  EXPECT_NEAR(wheel.measure(), 1000, 210);
  EXPECT_EQ(wheel.velocity.rejectedEdges(), 1);
  cycles(100, 1);
  EXPECT_NEAR(measured, 1000, 2.5);
  EXPECT_EQ(wheel.velocity.position() - before, HallCount(18));
}

/// @brief A velocity of 599 rpm is measured. A velocity of 605 rpm, which an unloaded motor cannot
/// reach, is rejected.
/// @verifies FR-124
TEST_F(VelSensorTest, FR124_RefusesMoreThan600Rpm) {
  for (const int direction : {1, -1}) {
    cycles(599 * direction, 5);
    EXPECT_NEAR(measured, 5990 * direction, 20);
    const Instant written = wheel.pipe.read()->at;
    cycles(605 * direction, 1);
    cycles(605 * direction, 1);
    EXPECT_LE(wheel.pipe.read()->at - written, kCycle);
    cycles(300 * direction, 2);
    EXPECT_NEAR(measured, 3000 * direction, 10);
  }
}

/// @brief A sensor is displaced by 30 electrical degrees, which are a third of the distance between
/// two edges. From 70 rpm to 450 rpm, the error of the velocity is at most 5 %.
/// @verifies FR-120
TEST_F(VelSensorTest, FR120_SensorThirtyElectricalDegreesOffItsPlace) {
  for (const int rpm : {70, 150, 300, 450, -70, -300}) {
    TurningWheel one;
    one.misplacement = 1.0 / 3;
    for (int cycle = 0; cycle < 25; ++cycle) {
      one.turn(rpm, kCycle);
      const double measuredNow = one.measure();
      if (cycle >= 5) {
        ASSERT_NEAR(measuredNow, rpm * 10, std::abs(rpm) * 0.5) << rpm;
      }
    }
    EXPECT_EQ(one.velocity.rejectedEdges(), 0);
  }
}

/// @brief A wheel turns at 100 rpm or more, and one of its sensors no longer causes edges. No
/// velocity is written in the next two cycles.
/// @verifies FR-220
TEST_F(VelSensorTest, FR220_DeadSensorMakesTheVelocityMissing) {
  for (const int rpm : {100, 150, 300, -300}) {
    TurningWheel one;
    for (int cycle = 0; cycle < 5; ++cycle) {
      one.turn(rpm, kCycle);
      one.measure();
    }
    const Instant good = one.time.now();
    one.deadB = true;
    for (int cycle = 0; cycle < 2; ++cycle) {
      one.turn(rpm, kCycle);
      one.measure();
    }
    EXPECT_EQ(one.pipe.read()->at, good) << rpm;
    EXPECT_GE(one.velocity.rejectedEdges(), 8) << rpm;
  }
}

/// @brief A sensor fails at any time of a cycle, while the wheel turns at 90 rpm or more. No
/// velocity is written in the three cycles after this cycle.
/// @verifies FR-220
TEST_F(VelSensorTest, FR220_SensorThatFailsWithinACycle) {
  for (const int rpm : {90, 95, 100, 105, 109, 150, 300, -100}) {
    for (int phase = 0; phase < 10; ++phase) {
      for (int failsAfter = 0; failsAfter < 100; ++failsAfter) {  // [ms]
        TurningWheel one;
        one.turn(rpm, Microseconds(1000 * phase));
        for (int cycle = 0; cycle < 5; ++cycle) {
          one.turn(rpm, kCycle);
          one.measure();
        }
        one.turn(rpm, milliseconds(failsAfter));
        one.deadB = true;
        one.turn(rpm, kCycle - milliseconds(failsAfter));
        one.measure();
        const Instant failed = one.time.now();
        for (int cycle = 0; cycle < 3; ++cycle) {
          one.turn(rpm, kCycle);
          one.measure();
        }
        ASSERT_LE(one.pipe.read()->at, failed) << rpm << " " << phase << " " << failsAfter;
      }
    }
  }
}

/// @brief A short disturbance on the wire of one sensor causes two implausible edges. The velocity
/// stays valid. If one cycle has two disturbances, the velocity is invalid for this cycle.
/// @verifies FR-220
TEST_F(VelSensorTest, FR220_OneDisturbanceInACycleLeavesTheVelocity) {
  const auto disturb = [this](int times) {
    for (int i = 0; i < times; ++i) {
      wheel.turn(100, milliseconds(25));
      wheel.edge(1);
      wheel.edge(-1);
    }
    wheel.turn(100, kCycle - milliseconds(25 * times));
    wheel.measure();
  };
  cycles(100, 5);
  disturb(1);
  EXPECT_EQ(wheel.pipe.read()->at, wheel.time.now());
  EXPECT_NEAR(wheel.pipe.read()->value.count(), 1000, 20);
  disturb(2);
  EXPECT_NE(wheel.pipe.read()->at, wheel.time.now());
  cycles(100, 1);
  EXPECT_EQ(wheel.pipe.read()->at, wheel.time.now());
  EXPECT_NEAR(measured, 1000, 20);
}

/// @brief At 30 rpm or more, in either direction, edges with alternating directions are
/// implausible. If a cycle has two disturbances, the velocity is invalid.
/// @verifies FR-220
TEST_F(VelSensorTest, FR220_DisturbancesCountFrom30Rpm) {
  for (const int direction : {1, -1}) {
    for (const int tenths : {300, 299}) {
      TurningWheel one;
      for (int edges = 0; edges < 12; ++edges) {
        one.turn(0, Microseconds(10'000'000 / tenths));
        one.edge(direction);
        one.velocity.measure();
      }
      ASSERT_EQ(one.pipe.read()->value.count(), direction * tenths);
      for (int i = 0; i < 2; ++i) {
        one.turn(0, milliseconds(1));
        one.edge(-direction);
        one.edge(direction);
      }
      one.velocity.measure();
      EXPECT_EQ(one.pipe.read()->at != one.time.now(), tenths == 300) << direction;
    }
  }
}

/// @brief A wheel at rest on an edge may cause many edges forwards and backwards. Its velocity
/// stays valid.
/// @verifies FR-220
TEST_F(VelSensorTest, FR220_JitterAtRestIsNoDisturbance) {
  cycles(0, 3);
  for (int cycle = 0; cycle < 20; ++cycle) {
    for (int i = 0; i < 25; ++i) {
      wheel.turn(0, milliseconds(2));
      wheel.edge(1);
      wheel.turn(0, milliseconds(2));
      wheel.edge(-1);
    }
    wheel.measure();
    ASSERT_EQ(wheel.pipe.read()->at, wheel.time.now());
    ASSERT_LE(std::abs(wheel.pipe.read()->value.count()), 100);
  }
}

/// @brief If the levels of both sensors change at the same time, the direction is unknown. If a
/// cycle has four of these changes, the velocity is invalid, also at rest.
/// @verifies FR-220
TEST_F(VelSensorTest, FR220_UnclearEdgesMakeTheVelocityMissing) {
  cycles(0, 3);
  for (int i = 0; i < 3; ++i) {
    wheel.show(i % 2 == 0 ? 3 : 0);
  }
  cycles(0, 1);
  EXPECT_EQ(wheel.pipe.read()->at, wheel.time.now());
  for (int i = 0; i < 4; ++i) {
    wheel.show(i % 2 == 0 ? 0 : 3);
  }
  wheel.turn(0, kCycle);
  wheel.velocity.measure();
  EXPECT_NE(wheel.pipe.read()->at, wheel.time.now());
}

/// @brief While a wheel turns, two kinds of edges are counted together: simultaneous changes of
/// both levels, and reversals. If a cycle has two edges of each kind, the velocity is invalid.
/// @verifies FR-220
TEST_F(VelSensorTest, FR220_UnclearEdgesAndReversalsCountTogether) {
  for (const bool unclear : {false, true}) {
    for (const bool reversals : {false, true}) {
      TurningWheel one;
      for (int cycle = 0; cycle < 5; ++cycle) {
        one.turn(100, kCycle);
        one.measure();
      }
      one.turn(100, milliseconds(25));
      if (unclear) {
        one.show(one.phase() ^ 3U);
        one.show(one.phase());
      }
      if (reversals) {
        one.edge(-1);
        one.edge(1);
      }
      one.turn(100, milliseconds(75));
      one.measure();
      EXPECT_EQ(one.velocity.rejectedEdges(), (unclear ? 2 : 0) + (reversals ? 2 : 0));
      EXPECT_EQ(one.pipe.read()->at != one.time.now(), unclear && reversals);
    }
  }
}

/// @brief Simultaneous changes of both levels in earlier cycles do not make a velocity invalid.
/// @verifies FR-220
TEST_F(VelSensorTest, FR220_UnclearEdgesOfEarlierCyclesDoNotCount) {
  cycles(0, 3);
  for (int cycle = 0; cycle < 5; ++cycle) {
    wheel.show(3);
    wheel.show(0);
    cycles(0, 1);
    EXPECT_EQ(wheel.pipe.read()->at, wheel.time.now()) << cycle;
  }
}

/// @brief The count of implausible edges does not stop at 65535. Therefore the number of
/// implausible edges in a cycle can be computed at any time.
/// @verifies FR-123
TEST_F(VelSensorTest, FR123_TheCountDoesNotStop) {
  for (int i = 0; i < 70000; ++i) {
    wheel.show(3);
    wheel.show(0);
  }
  wheel.velocity.measure();
  EXPECT_GT(wheel.velocity.rejectedEdges(), 65535);
}

/// @brief The position and the velocity of a cycle belong to the same time. Edges after the
/// measurement belong to the next measurement.
/// @verifies FR-121
TEST_F(VelSensorTest, FR121_PositionIsThatOfTheMeasurement) {
  cycles(100, 2);
  const HallCount position = wheel.velocity.position();
  wheel.turn(100, milliseconds(50));
  EXPECT_EQ(wheel.velocity.position(), position);
  wheel.measure();
  EXPECT_EQ(wheel.velocity.position() - position, HallCount(5));
}

/// A function that records its arguments.
class RecordedFunction final : public Function {
 public:
  [[nodiscard]] std::optional<std::int32_t> calculate(const Arguments& arguments) const override {
    arguments.fill(values);
    return 0;
  }
  mutable ArgumentValues values;
};

/// @brief The function gets the number of edges, their duration, the scale of one edge, the divisor
/// 1 and the offset 0.
/// @verifies FR-120
TEST_F(VelSensorTest, FR120_ArgumentsOfTheFunction) {
  RecordedFunction function;
  VelSensor sensor(wheel.collector, function, wheel.time, wheel.pipe);
  wheel.turn(0, milliseconds(50));
  wheel.edge(1);
  sensor.measure();
  wheel.turn(0, milliseconds(20));
  wheel.edge(1);
  wheel.edge(1);
  sensor.measure();
  EXPECT_EQ(function.values[ArgumentId::Raw], 2);
  EXPECT_EQ(function.values[ArgumentId::Elapsed], 20000);
  EXPECT_EQ(function.values[ArgumentId::Scale], 10'000'000);
  EXPECT_EQ(function.values[ArgumentId::Divisor], 1);
  EXPECT_EQ(function.values[ArgumentId::Offset], 0);
}

/// @brief A value has the time of its measurement.
/// @verifies FR-120
TEST_F(VelSensorTest, FR120_TellsWhenItWasMeasured) {
  cycles(100, 3);
  EXPECT_EQ(wheel.pipe.read()->at, wheel.time.now());
}

/// @brief The position increases forwards and decreases backwards, for any movement of the wheel.
/// @verifies FR-121
TEST_F(VelSensorTest, FR121_FollowsAnyMovement) {
  std::mt19937 random(seed());
  std::uniform_real_distribution<double> velocity(-300, 300);
  std::uniform_int_distribution<int> duration(1, 200000);
  for (int i = 0; i < 300; ++i) {
    wheel.turn(velocity(random), Microseconds(duration(random)));
    wheel.velocity.measure();
    ASSERT_EQ(wheel.velocity.position().count(), wheel.passed);
  }
}

/// @brief The first edge after the start is already counted, because the levels of both Hall
/// sensors are read at the start.
/// @verifies FR-121
TEST_F(VelSensorTest, FR121_CountsFromTheFirstEdge) {
  wheel.turn(0, milliseconds(10));
  wheel.edge(-1);
  wheel.measure();
  EXPECT_EQ(wheel.velocity.position(), HallCount(-1));
}

}  // namespace
}  // namespace wr::test
