#include "wheel_control/CoupledWheels.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>

namespace wr::test {
namespace {

void drive(CoupledWheels& robot, const WheelSetPoint& setPoint, int cycles) {
  for (int cycle = 0; cycle < cycles; ++cycle) {
    robot.cycle(setPoint);
  }
}

/// Checks that the voltage of wheel 0 is within 10 % of the mean of the other wheels.
void expectShared(const CoupledWheels& robot) {
  const double others = robot.tensionOfTheOthers();
  EXPECT_NEAR(robot.tension(0), others, std::abs(others) * 0.1);
}

/// @brief Wheel 0 has no Hall edges for four cycles. Beginning 29 cycles after the end of this gap,
/// its voltage stays within 10 % of the voltage of the other wheels.
/// @verifies FR-224
TEST(CoupledWheels, FR224_WheelsDoNotFightAfterLostEdges) {
  for (const int velocity : {500, 1000, -1000}) {
    const WheelSetPoint setPoint = velocityOf(static_cast<std::int16_t>(velocity));
    CoupledWheels robot;
    drive(robot, setPoint, 50);
    robot.wheels[0].hallWorks = false;
    drive(robot, setPoint, 4);
    robot.wheels[0].hallWorks = true;
    drive(robot, setPoint, 29);
    for (int cycle = 0; cycle < 50; ++cycle) {
      drive(robot, setPoint, 1);
      expectShared(robot);
    }
    EXPECT_FALSE(robot.wheels[0].work.measured.blind);
  }
}

/// @brief While wheel 0 has no Hall edges for four cycles, wheel 1 is less than 5 % faster than
/// ordered.
/// @verifies FR-224
TEST(CoupledWheels, FR224_LostEdgesDoNotSpeedUpTheRobot) {
  CoupledWheels robot;
  drive(robot, velocityOf(1000), 50);
  robot.wheels[0].hallWorks = false;
  for (int cycle = 0; cycle < 4; ++cycle) {
    drive(robot, velocityOf(1000), 1);
    EXPECT_LT(robot.wheels[1].velocity(), 1050);
  }
}

/// @brief If a bit changes in any copy of the integral, of the model or of the set-point of wheel
/// 0, this bit is corrected. The voltage of the wheel stays within 10 % of the voltage of the other
/// wheels.
/// @verifies FR-224
TEST(CoupledWheels, FR224_OneBitChangesNothing) {
  CoupledWheels robot;
  drive(robot, velocityOf(1000), 50);
  // Some values are stored three times. The test finds these values as three equal words.
  auto* const bytes = reinterpret_cast<unsigned char*>(&robot.wheels[0].velocityAlgorithm);
  constexpr std::size_t kWord = sizeof(std::int32_t);
  std::size_t copies = 0;
  for (std::size_t at = 0; at + 3 * kWord <= sizeof(VelocityAlgorithm); at += kWord) {
    if (std::memcmp(bytes + at, bytes + at + kWord, 2 * kWord) != 0 ||
        std::memcmp(bytes + at, "\0\0\0", kWord) == 0) {
      continue;
    }
    ++copies;
    for (std::size_t bit = 0; bit < 3 * kWord * 8; ++bit) {
      bytes[at + bit / 8] ^= static_cast<unsigned char>(1U << bit % 8);
      drive(robot, velocityOf(1000), 1);
      expectShared(robot);
    }
    at += 2 * kWord;  // the next word may have the same value by chance
  }
  EXPECT_EQ(copies, 3U);
}

}  // namespace
}  // namespace wr::test
