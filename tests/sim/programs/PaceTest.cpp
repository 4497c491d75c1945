#include <gtest/gtest.h>

#include <chrono>

#include "sim/programs/Pace.hpp"

namespace wr::test {
namespace {

using programs::Pace;
using std::chrono::milliseconds;

constexpr milliseconds kGreatestDelay{20};  // after a greater delay, the robot does not catch up

/// A clock that advances only when the test advances it, or when the pace sleeps.
class PaceOfTheRobot : public testing::Test {
 protected:
  Pace::Clock::time_point clock;
  Pace pace{[this] { return clock; }, [this](Pace::Clock::time_point until) { clock = until; }};
};

/// @brief The pace waits until the clock has reached the time of the robot.
TEST_F(PaceOfTheRobot, WaitsForTheClock) {
  pace.waitFor(milliseconds(5));
  EXPECT_EQ(clock.time_since_epoch(), milliseconds(5));
  pace.waitFor(milliseconds(6));
  EXPECT_EQ(clock.time_since_epoch(), milliseconds(6));
}

/// @brief If the computer is late by up to 20 ms, the time of the robot catches up.
TEST_F(PaceOfTheRobot, MakesUpForAShortDelay) {
  clock += milliseconds(5) + kGreatestDelay;
  pace.waitFor(milliseconds(5));
  EXPECT_EQ(clock.time_since_epoch(), milliseconds(25));
  EXPECT_EQ(pace.lost(), milliseconds(0));
  pace.waitFor(milliseconds(30));
  EXPECT_EQ(clock.time_since_epoch(), milliseconds(30));
}

/// @brief If the computer is late by more than 20 ms, the time of the robot continues without
/// catching up.
TEST_F(PaceOfTheRobot, StandsStillWhileTheMachineIsLate) {
  clock += milliseconds(5) + kGreatestDelay + milliseconds(1);
  pace.waitFor(milliseconds(5));
  EXPECT_EQ(pace.lost(), milliseconds(21));
  clock += milliseconds(1000);
  pace.waitFor(milliseconds(5));
  EXPECT_EQ(pace.lost(), milliseconds(1021));
  pace.waitFor(milliseconds(6));
  EXPECT_EQ(clock.time_since_epoch(), milliseconds(1027));
}

/// @brief By default, the clock of the computer is used.
TEST_F(PaceOfTheRobot, FollowsTheMachine) {
  const auto before = Pace::Clock::now();
  Pace real;
  real.waitFor(milliseconds(2));
  EXPECT_GE(Pace::Clock::now() - before, milliseconds(2));
}

}  // namespace
}  // namespace wr::test
