#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "main_control/ControllerFixture.hpp"
#include "products/safety/SourceMode.hpp"
#include "safety/PersistentStop.hpp"
#include "safety/RetainedStop.hpp"
#include "safety/SteeringGeometry.hpp"

namespace wr::test {
namespace {

SetPoints alike(std::int16_t value, int steering) {
  SetPoints order;
  order.steering = Angle(steering);
  order.wheels.fill({.quantity = WheelQuantity::Velocity, .value = value});
  return order;
}

class SteeringGeometryTest : public ControllerFixture {
 protected:
  SetPoints read(const SetPoints& order) {
    source.order = order;
    mode.read(controller);
    return *data.setPoints();
  }

  SourceMode source;
  SteeringGeometry mode{source};
};

/// @brief changeMode() of the decorators SteeringGeometry and PersistentStop has no effect.
/// @verifies FR-17
TEST_F(SteeringGeometryTest, FR17_LeavesTheChangeOfTheModeToTheMode) {
  RetainedStop::Cells cells{};
  RetainedStop memory{cells};
  PersistentStop persistent(source, memory);
  const Mode& before = controller.getMode();
  mode.changeMode(controller);
  persistent.changeMode(controller);
  EXPECT_EQ(&controller.getMode(), &before);
}

/// @brief Straight ahead, all wheels get the ordered velocity.
/// @verifies FR-284
TEST_F(SteeringGeometryTest, FR284_StraightOnAllWheelsAreAlike) {
  EXPECT_EQ(read(alike(1234, 0)), alike(1234, 0));
}

/// @brief In a curve, all wheels drive on circles around one centre. At each steering angle, the
/// velocities of the wheels are proportional to the radii of their circles. The error is at most
/// the greater of 0.1 rpm and 0.5 % of the ordered velocity. No wheel is faster than ordered.
/// @verifies FR-284
TEST_F(SteeringGeometryTest, FR284_EachWheelTurnsOnItsCircle) {
  constexpr double kWheelbase = 1.582;
  constexpr double kTrack = 1.054;
  for (int steering = -3200; steering <= 3200; steering += 50) {
    if (steering == 0) {
      continue;
    }
    const double angle = steering / 100.0 * std::numbers::pi / 180;
    // distance from the middle of the rear axle to the centre of all circles, positive to the left
    // [m]
    const double centre = kWheelbase / std::tan(angle);
    std::array<double, 4> circles{};
    for (std::size_t wheel = 0; wheel < 4; ++wheel) {
      const double across = (wheel % 2 == 0 ? 1 : -1) * kTrack / 2;
      const double along = wheel < 2 ? kWheelbase : 0;
      circles.at(wheel) = std::hypot(centre - across, along);
    }
    const double greatest = *std::ranges::max_element(circles);
    for (const int ordered : {-3000, -201, -190, -100, -10}) {
      const SetPoints order = read(alike(static_cast<std::int16_t>(ordered), steering));
      for (std::size_t wheel = 0; wheel < 4; ++wheel) {
        const double expected = ordered * circles.at(wheel) / greatest;
        EXPECT_NEAR(order.wheels.at(wheel).value, expected, std::max(1.0, -0.005 * ordered))
            << ordered << " at " << steering << " wheel " << wheel;
        EXPECT_GE(order.wheels.at(wheel).value, ordered);
      }
      EXPECT_EQ(order.steering, Angle(steering));
    }
  }
}

/// @brief At 32 degrees to the left, the inner rear wheel has 58.2 % of the velocity of the outer
/// front wheel. The robot drives on a circle with a radius of 2.5 m. An angle beyond 32 degrees
/// counts as 32 degrees.
/// @verifies FR-284
TEST_F(SteeringGeometryTest, FR284_FullLock) {
  const SetPoints order = read(alike(1000, 3200));
  EXPECT_EQ(order.wheels[1].value, 1000);
  EXPECT_NEAR(order.wheels[2].value, 582, 3);
  EXPECT_EQ(read(alike(1000, 4000)).wheels[2].value, order.wheels[2].value);
}

/// @brief An order is not changed if the values of its wheels are not all equal. An order that sets
/// no velocity is not changed either.
/// @verifies FR-284
TEST_F(SteeringGeometryTest, FR284_OtherOrdersStay) {
  SetPoints different = alike(1000, 2000);
  different.wheels[3].value = 999;
  EXPECT_EQ(read(different), different);
  SetPoints voltage = alike(1000, 2000);
  for (WheelSetPoint& wheel : voltage.wheels) {
    wheel.quantity = WheelQuantity::Tension;
  }
  EXPECT_EQ(read(voltage), voltage);
}

class PersistentStopTest : public ControllerFixture {
 protected:
  PersistentStopTest() { memory.begin(ResetCause::PowerOn); }

  RetainedStop::Cells cells{};
  RetainedStop memory{cells};
  SourceMode source;
};

/// @brief The stop of the source is stored. When the source releases this stop, the stored stop is
/// cleared.
/// @verifies FR-290
TEST_F(PersistentStopTest, FR290_TheStopIsStored) {
  PersistentStop mode(source, memory);
  mode.serve();
  EXPECT_EQ(source.served, 1);
  EXPECT_FALSE(mode.stopOrdered());
  source.stop = true;
  mode.serve();
  EXPECT_TRUE(memory.stopped());
  source.stop = false;
  mode.serve();
  EXPECT_FALSE(memory.stopped());
}

/// @brief If a stop was in force before a reset, it lasts until a neutral order without a stop is
/// read.
/// @verifies FR-290
TEST_F(PersistentStopTest, FR290_AStopOutlivesAReset) {
  memory.save(true);
  memory.begin(ResetCause::Watchdog);
  PersistentStop mode(source, memory);
  mode.serve();
  EXPECT_TRUE(mode.stopOrdered());
  source.order = alike(1, 0);
  mode.read(controller);
  EXPECT_TRUE(mode.stopOrdered());
  source.order = alike(0, 0);
  source.stop = true;
  mode.read(controller);
  source.stop = false;
  EXPECT_TRUE(mode.stopOrdered());
  mode.serve();
  EXPECT_TRUE(memory.stopped());
  mode.read(controller);
  EXPECT_FALSE(mode.stopOrdered());
  mode.serve();
  EXPECT_FALSE(memory.stopped());
}

/// @brief After power-on, no stop is in force, even if the content of the memory is random.
/// @verifies FR-290
TEST_F(PersistentStopTest, FR290_PowerOnBeginsWithoutAStop) {
  cells = {.value = 0x12345678, .check = 0x9ABCDEF0};
  memory.begin(ResetCause::PowerOn);
  EXPECT_FALSE(memory.stopped());
}

/// @brief After every reset except power-on, a stored stop is still in force. A released stop is
/// not in force.
/// @verifies FR-290
TEST_F(PersistentStopTest, FR290_OtherResetsKeepTheMemory) {
  for (const ResetCause cause :
       {ResetCause::Unknown, ResetCause::LowVoltage, ResetCause::Pin, ResetCause::Watchdog,
        ResetCause::ClockLost, ResetCause::Lockup, ResetCause::Software, ResetCause::Debugger}) {
    for (const bool stopped : {false, true}) {
      memory.save(stopped);
      memory.begin(cause);
      EXPECT_EQ(memory.stopped(), stopped);
    }
  }
}

/// @brief If any bit of the memory is damaged, the memory counts as a stored stop. A value in which
/// all bits are 0 or all bits are 1 also counts as a stored stop, even if its check value matches.
/// @verifies FR-290
TEST_F(PersistentStopTest, FR290_DamagedMemoryIsAStop) {
  memory.save(false);
  const RetainedStop::Cells whole = cells;
  for (int bit = 0; bit < 32; ++bit) {
    cells = whole;
    cells.value ^= 1U << bit;
    EXPECT_TRUE(memory.stopped()) << bit;
    cells = whole;
    cells.check ^= 1U << bit;
    EXPECT_TRUE(memory.stopped()) << bit;
  }
  for (const std::uint32_t word : {0U, 0xFFFFFFFFU}) {
    cells = {.value = word, .check = ~word};
    EXPECT_TRUE(memory.stopped());
  }
}

}  // namespace
}  // namespace wr::test
