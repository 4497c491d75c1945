#include "steering_control/DirSystem.hpp"

#include <gtest/gtest.h>

#include "main_control/control_systems/ControlSystemPool.hpp"
#include "support/FakeTimebase.hpp"

namespace wr::test {
namespace {

/// @brief The steering with the interface for Main Control. The test generates the ticks.
struct DirSystemTest : testing::Test {
  DirSystemTest() { pool.add(system); }

  void publish(const DirStatus& what) { status.write(what, clock.now()); }

  /// @brief Orders a hold in a new cycle, and collects the measurements.
  void cycle() {
    pool.hold(++number);
    pool.collect(measurements, outputs);
  }

  FakeTimebase clock;
  Pipe<DirTarget> target;
  Pipe<DirStatus> status;
  DirSystem system{{.target = target, .status = status, .timebase = clock}};
  ControlSystemPool pool;
  std::uint32_t number = 0;
  Measurements measurements;
  Outputs outputs;
};

/// @brief control() passes the ordered angle to the steering, with the time of the order.
/// @verifies FR-115
TEST_F(DirSystemTest, FR115_TheOrderedAngleIsHandedOver) {
  clock.advance(milliseconds(100));
  EXPECT_FALSE(target.read());
  pool.control({.steering = Angle(-1500)}, 1);
  EXPECT_EQ(target.read()->value, (DirTarget{.angle = Angle(-1500), .follow = true}));
  EXPECT_EQ(target.read()->at, clock.now());
}

/// @brief hold() passes an order to hold to the steering.
/// @verifies FR-115
TEST_F(DirSystemTest, FR115_TheOrderToHoldIsHandedOver) {
  pool.control({.steering = Angle(-1500)}, 1);
  clock.advance(milliseconds(100));
  pool.hold(2);
  EXPECT_EQ(target.read()->value, DirTarget{});
  EXPECT_EQ(target.read()->at, clock.now());
}

/// @brief After an acknowledgement, the steering gets an order that releases its fault. The next
/// order does not release a fault.
/// @verifies FR-112
TEST_F(DirSystemTest, FR112_AReleaseIsHandedOverOnce) {
  pool.acknowledge(1);
  EXPECT_TRUE(target.read()->value.release);
  pool.hold(2);
  EXPECT_FALSE(target.read()->value.release);
}

/// @brief Two objects of the class DirTarget are equal only when all their values are equal.
TEST_F(DirSystemTest, TargetsAreCompared) {
  EXPECT_EQ(DirTarget{}, DirTarget{});
  EXPECT_NE(DirTarget{}, (DirTarget{.follow = true}));
  EXPECT_NE(DirTarget{}, (DirTarget{.angle = Angle(1)}));
}

/// @brief The collected state, end stops, position and turn are the values of the newest tick.
/// @verifies FR-116
TEST_F(DirSystemTest, FR116_TellsTheNewestTick) {
  publish({});
  publish({.state = SteeringState::Turning,
           .rate = StepRate(-30),
           .leftEnd = true,
           .position = Stamped<Angle>{Angle(250), clock.now()}});
  cycle();
  EXPECT_EQ(measurements.steeringState, SteeringState::Turning);
  EXPECT_TRUE(measurements.leftEnd);
  EXPECT_FALSE(measurements.rightEnd);
  EXPECT_EQ(measurements.steering, Angle(250));
  EXPECT_EQ(outputs.turn, -1);
}

/// @brief The collected turn is the sign of the rate of the motor: -1, 0 or 1.
/// @verifies FR-116
TEST_F(DirSystemTest, FR116_TheTurnIsTheSignOfTheRate) {
  for (const std::int32_t rate : {-500, -1, 0, 1, 500}) {
    publish({.rate = StepRate(rate), .rightEnd = true});
    cycle();
    EXPECT_EQ(outputs.turn, rate == 0 ? 0 : rate / std::abs(rate));
    EXPECT_TRUE(measurements.rightEnd);
  }
}

/// @brief A cycle collects the values that were present when the cycle sent its order to the
/// steering. A later tick does not change these values.
/// @verifies FR-116
TEST_F(DirSystemTest, FR116_TheCycleKeepsItsValues) {
  publish({.state = SteeringState::Holding});
  pool.hold(1);
  publish({.state = SteeringState::Fault});
  pool.collect(measurements, outputs);
  EXPECT_EQ(measurements.steeringState, SteeringState::Holding);
}

/// @brief If the position of the steering is older than 150 ms, it is reported as missing, even if
/// the last tick is recent.
/// @verifies FR-116
TEST_F(DirSystemTest, FR116_AnOldPositionIsMissing) {
  const Stamped<Angle> position{Angle(250), clock.now()};
  clock.advance(milliseconds(150));
  publish({.position = position});
  cycle();
  EXPECT_EQ(measurements.steering, Angle(250));
  clock.advance(Microseconds(1));
  publish({.position = position});
  cycle();
  EXPECT_EQ(measurements.steering, std::nullopt);
}

/// @brief If the position of the steering was never measured, it is reported as missing.
/// @verifies FR-116
TEST_F(DirSystemTest, FR116_APositionThatIsUnknownIsMissing) {
  measurements.steering = Angle(1);
  publish({});
  cycle();
  EXPECT_EQ(measurements.steering, std::nullopt);
}

/// @brief The work of a cycle is complete under two conditions: the steering got an order in this
/// cycle, and its newest status is at most 20 ms old.
/// @verifies FR-117
TEST_F(DirSystemTest, FR117_OnlyASteeringThatTicksCompletes) {
  publish({});
  clock.advance(milliseconds(20));
  cycle();
  EXPECT_TRUE(pool.completed(1));
  EXPECT_FALSE(pool.completed(2));
  clock.advance(Microseconds(1));
  cycle();
  EXPECT_FALSE(pool.completed(2));
  publish({});
  cycle();
  EXPECT_TRUE(pool.completed(3));
}

/// @brief Before its first tick, the steering completes no work and reports that it is off.
/// @verifies FR-117
TEST_F(DirSystemTest, FR117_BeforeTheFirstTickNothingIsComplete) {
  outputs.turn = std::int8_t{1};
  cycle();
  EXPECT_FALSE(pool.completed(1));
  EXPECT_EQ(measurements, Measurements{});
  EXPECT_EQ(outputs, Outputs{});
}

}  // namespace
}  // namespace wr::test
