#include <gtest/gtest.h>

#include "steering_control/DirSystem.hpp"
#include "wheel_control/SensedWheel.hpp"

namespace wr::test {
namespace {

constexpr Microseconds kLifetime = milliseconds(150);

/// @brief If a velocity sensor stops writing, its velocity counts as missing after 150 ms.
/// @verifies FR-127
TEST(MeasurementLifetime, FR127_Velocity) {
  SensedWheel wheel;
  WheelWork work;
  wheel.readVelocity.execute(work);
  EXPECT_EQ(work.measured.velocity, Velocity(0));
  wheel.time.advance(kLifetime);
  EXPECT_EQ(wheel.controller.velocity(wheel.time.now()), Velocity(0));
  wheel.time.advance(Microseconds(1));
  EXPECT_FALSE(wheel.controller.velocity(wheel.time.now()));
}

/// @brief If a converter has no new samples, the current counts as missing after 150 ms.
/// @verifies FR-127
/// @verifies FR-173
TEST(MeasurementLifetime, FR127_Current) {
  SensedWheel wheel;
  WheelWork work;
  wheel.pass(false, SensedWheel::kMiddle);
  wheel.pass(false, SensedWheel::kMiddle);  // 200 samples are 25 groups of 8
  wheel.time.advance(kLifetime);
  work.at = wheel.time.now();
  wheel.readCurrent.execute(work);
  EXPECT_EQ(work.measured.current, Current(0));
  wheel.time.advance(Microseconds(1));
  work.at = wheel.time.now();
  wheel.readCurrent.execute(work);
  EXPECT_FALSE(work.measured.current);
}

/// @brief If the angle sensor has no new samples, the angle counts as missing after 150 ms.
/// @verifies FR-127
TEST(MeasurementLifetime, FR127_Angle) {
  FakeTimebase time;
  Pipe<DirTarget> targets;
  Pipe<DirStatus> statuses;
  DirSystem system({.target = targets, .status = statuses, .timebase = time});
  const auto angle = [&] {
    Measurements measurements;
    Outputs outputs;
    system.hold(1);
    system.collect(measurements, outputs);
    return measurements.steering;
  };
  statuses.write({.position = Stamped<Angle>{Angle(70), time.now()}}, time.now());
  time.advance(kLifetime);
  EXPECT_EQ(angle(), Angle(70));
  time.advance(Microseconds(1));
  EXPECT_FALSE(angle());
}

}  // namespace
}  // namespace wr::test
