#include "wheel_control/behaviours/Reverse.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "support/seed.hpp"
#include "wheel_control/ControlledWheel.hpp"
#include "wheel_control/behaviours/SpyCommand.hpp"

namespace wr::test {
namespace {

class ReverseTest : public testing::Test, protected SpiedCommands {
 protected:
  Tension apply(int demand, int velocity) {
    return reverse.apply(Tension(demand), Velocity(velocity));
  }

  Advance advance{setTension};
  SoftStart softStart{advance};
  Stop stop{setTension, stopWheel};
  Reverse reverse{softStart, stop, setOrientation};
};

/// @brief A demand in the present orientation is applied.
/// @verifies FR-87
TEST_F(ReverseTest, FR87_DemandInTheOrientationPasses) {
  EXPECT_EQ(apply(5000, 900), Tension(5000));
  EXPECT_EQ(apply(0, 900), Tension(0));
  EXPECT_EQ(log, (CommandLog{{"tension", 5000}, {"tension", 0}}));
}

/// @brief A demand has the direction opposite to the orientation. If it is less than 0.1 V, it
/// counts as 0 and has no effect, because noise can cause such a demand.
/// @verifies FR-80
/// @verifies FR-87
TEST_F(ReverseTest, FR87_SlightDemandTurnsNothing) {
  apply(5000, 0);
  for (int cycle = 0; cycle < 4; ++cycle) {
    EXPECT_EQ(apply(-99, 0), Tension(0));
  }
  EXPECT_EQ(apply(-100, 0), Tension(0));
  EXPECT_EQ(apply(-100, 0), Tension(-100));
  EXPECT_EQ(apply(99, 0), Tension(0));
  EXPECT_EQ(apply(-99, 0), Tension(-99));
  EXPECT_EQ(apply(100, 0), Tension(0));
  EXPECT_EQ(apply(100, 0), Tension(100));
}

/// @brief When a demand has the direction opposite to the orientation, the wheel is stopped. After
/// two slow cycles without voltage, the orientation changes, and the demand is applied.
/// @verifies FR-87
TEST_F(ReverseTest, FR87_StopsThenTurns) {
  apply(4000, 900);
  log.clear();
  EXPECT_EQ(apply(-5000, 800), Tension(1600));
  EXPECT_EQ(apply(-5000, 500), Tension(0));
  EXPECT_EQ(apply(-5000, 400), Tension(0));
  EXPECT_EQ(apply(-5000, 399), Tension(0));
  EXPECT_EQ(apply(-5000, 0), Tension(-5000));
  EXPECT_EQ(log, (CommandLog{{"tension", 1600},
                             {"stop", 0},
                             {"stop", 0},
                             {"stop", 0},
                             {"orientation", -5000},
                             {"tension", -5000}}));
}

/// @brief If the wheel is not slow in a cycle and turns in the direction opposite to the demand,
/// this cycle sets the count of slow cycles to 0.
/// @verifies FR-87
TEST_F(ReverseTest, FR87_SlowCyclesAreInARow) {
  for (const int velocity : {10, 400, -10, 400, 10}) {
    apply(-5000, velocity);
  }
  EXPECT_EQ(std::ranges::count(log, "orientation", &CommandLog::value_type::first), 0);
  apply(-5000, 10);
  EXPECT_EQ(std::ranges::count(log, "orientation", &CommandLog::value_type::first), 1);
}

/// @brief A halt sets the count of slow cycles to 0.
/// @verifies FR-87
TEST_F(ReverseTest, FR87_AHaltInterruptsTheSlowCycles) {
  apply(-5000, 100);
  reverse.resume(Tension());
  apply(-5000, 390);
  EXPECT_EQ(std::ranges::count(log, "orientation", &CommandLog::value_type::first), 0);
  apply(-5000, 390);
  EXPECT_EQ(std::ranges::count(log, "orientation", &CommandLog::value_type::first), 1);
}

/// @brief If a wheel turns in the direction of the demand for two cycles, its orientation changes
/// at any speed. While the wheel turns in the opposite direction at 40 rpm, its orientation does
/// not change.
/// @verifies FR-87
TEST_F(ReverseTest, FR87_AWheelThatTurnsAlongIsNoReversal) {
  EXPECT_EQ(apply(-5000, -2000), Tension(0));
  EXPECT_EQ(apply(-5000, -2000), Tension(-5000));
  EXPECT_EQ(apply(5000, -400), Tension(-2600));
  for (int cycle = 0; cycle < 10; ++cycle) {
    apply(5000, -400);
  }
  EXPECT_EQ(apply(5000, 401), Tension(0));
  EXPECT_EQ(apply(5000, 401), Tension(5000));
}

/// @brief Slow cycles do not change the orientation while the wheel has voltage.
/// @verifies FR-87
TEST_F(ReverseTest, FR87_NoTurnWhileTensionIsLeft) {
  reverse.resume(Tension(9600));
  for (int cycle = 0; cycle < 4; ++cycle) {
    apply(-5000, 0);
  }
  EXPECT_EQ(log,
            (CommandLog{{"tension", 7200}, {"tension", 4800}, {"tension", 2400}, {"stop", 0}}));
  EXPECT_EQ(apply(-5000, 0), Tension(-5000));
}

/// @brief The change of orientation from backwards to forwards has the same rules as the change
/// from forwards to backwards.
/// @verifies FR-87
TEST_F(ReverseTest, FR87_BackToForwards) {
  apply(-5000, 0);
  apply(-5000, 0);
  log.clear();
  EXPECT_EQ(apply(3000, -700), Tension(-2600));
  EXPECT_EQ(apply(3000, 0), Tension(-200));
  EXPECT_EQ(apply(3000, 0), Tension(0));
  EXPECT_EQ(apply(3000, 0), Tension(3000));
  EXPECT_EQ(log.back(), (CommandLog::value_type{"tension", 3000}));
}

/// @brief When a demand is in the present orientation, it ends the stop that a reversal has begun.
/// A later reversal counts its slow cycles from 0.
/// @verifies FR-87
TEST_F(ReverseTest, FR87_AgreementEndsTheStop) {
  apply(-5000, 0);
  EXPECT_EQ(apply(1000, 0), Tension(1000));
  EXPECT_EQ(apply(0, 0), Tension(0));
  EXPECT_EQ(apply(-5000, 0), Tension(0));
  EXPECT_EQ(apply(-5000, 0), Tension(-5000));
}

/// @brief After a change of orientation, the next change again needs two slow cycles. This is true
/// even when a trip has removed the voltage immediately.
/// @verifies FR-87
TEST_F(ReverseTest, FR87_NextTurnCountsFromZero) {
  apply(-5000, 0);
  ASSERT_EQ(apply(-5000, 0), Tension(-5000));
  reverse.resume(Tension(0));
  EXPECT_EQ(apply(5000, 0), Tension(0));
  EXPECT_EQ(apply(5000, 0), Tension(5000));
}

/// @brief When a stop is interrupted, the voltage rises from its value at the end of the stop.
/// @verifies FR-81
TEST_F(ReverseTest, FR81_RiseBeginsAtWhatIsLeft) {
  apply(12000, 0);
  apply(24000, 0);
  EXPECT_EQ(apply(-100, 1000), Tension(21600));
  EXPECT_EQ(apply(-100, 1000), Tension(19200));
  for (int cycle = 0; cycle < 6; ++cycle) {
    apply(-100, 1000);
  }
  EXPECT_EQ(apply(24000, 1000), Tension(16800));
}

/// @brief A slope keeps a wheel turning at 79 rpm. After ten cycles without voltage, this velocity
/// counts as slow. After two slow cycles, the orientation changes.
/// @verifies FR-87
TEST_F(ReverseTest, FR87_ACreepingWheelIsTurned) {
  apply(1000, 790);
  EXPECT_EQ(apply(-5000, 790), Tension(0));
  for (int cycle = 0; cycle < 11; ++cycle) {
    EXPECT_EQ(apply(-5000, 790), Tension(0)) << cycle;
  }
  EXPECT_EQ(apply(-5000, 790), Tension(-5000));
  EXPECT_EQ(apply(5000, -790), Tension(-2600));
  EXPECT_EQ(apply(5000, -790), Tension(-200));
  for (int cycle = 0; cycle < 12; ++cycle) {
    EXPECT_EQ(apply(5000, -790), Tension(0)) << cycle;
  }
  EXPECT_EQ(apply(5000, -790), Tension(5000));
}

/// @brief When a demand is in the present orientation, it sets the count of the cycles without
/// voltage to 0.
/// @verifies FR-87
TEST_F(ReverseTest, FR87_AgreementEndsTheCreep) {
  for (int cycle = 0; cycle < 10; ++cycle) {
    EXPECT_EQ(apply(-5000, 790), Tension(0)) << cycle;
  }
  apply(0, 790);
  for (int cycle = 0; cycle < 11; ++cycle) {
    EXPECT_EQ(apply(-5000, 790), Tension(0)) << cycle;
  }
  EXPECT_EQ(apply(-5000, 790), Tension(-5000));
}

/// @brief If a slope keeps a wheel turning at 80 rpm, its orientation never changes.
/// @verifies FR-87
TEST_F(ReverseTest, FR87_AFastWheelIsNotTurned) {
  apply(-5000, 0);
  ASSERT_EQ(apply(-5000, 0), Tension(-5000));
  for (int cycle = 0; cycle < 50; ++cycle) {
    EXPECT_LE(apply(5000, -800), Tension(0)) << cycle;
  }
}

/// @brief For any demand and measurement, the output follows three rules. The orientation changes
/// only without voltage, and only when the wheel is slow or turns in the direction of the demand.
/// In a cycle, the voltage rises by at most 12 V. While the demand has the direction opposite to
/// the orientation, the voltage falls by at most 2.4 V in a cycle.
/// @verifies FR-87
/// @verifies FR-81
TEST_F(ReverseTest, FR87_FR81_RulesHoldForAnyDemand) {
  std::mt19937 random(seed());
  std::uniform_int_distribution<int> demands(-24000, 24000);
  std::uniform_int_distribution<int> velocities(-960, 960);
  std::uniform_int_distribution<int> lengths(1, 12);
  int before = 0;
  int waited = 0;  // cycles without voltage
  int slow = 0;
  int flips = 0;
  for (int run = 0; run < 2000; ++run) {
    const int demand = demands(random);
    for (int left = lengths(random); left > 0; --left) {
      const int velocity = velocities(random);
      const bool along = demand > 0 ? velocity > 0 : velocity < 0;
      slow = std::abs(velocity) < (waited >= 10 ? 800 : 400) || along ? slow + 1 : 0;
      waited = before == 0 ? waited + 1 : 0;
      log.clear();
      const int applied = apply(demand, velocity).count();
      ASSERT_LE(std::abs(applied) - std::abs(before), 12000);
      const bool turned = log.front().first == "orientation";
      if (turned) {
        ++flips;
        ASSERT_GE(slow, 2);
        ASSERT_EQ(before, 0);
      }
      ASSERT_GE(applied * static_cast<long long>(before), 0)
          << "the voltage must be 0 before its sign changes";
      if (std::abs(demand) >= 100 && static_cast<long long>(demand) * before < 0) {
        ASSERT_GE(std::abs(applied), std::abs(before) - 2400);
      }
      before = applied;
    }
  }
  EXPECT_GT(flips, 10);
}

/// @brief At the outputs of the wheel, the orientation changes only while there is no voltage.
/// @verifies FR-87
TEST_F(ReverseTest, FR87_WheelTurnsWithoutTension) {
  ControlledWheel one;
  one.reverse.apply(Tension(2000), Velocity());
  one.reverse.apply(Tension(-2000), Velocity());
  EXPECT_FALSE(one.orientation.isOn());
  EXPECT_EQ(one.output(), Tension(0));
  one.reverse.apply(Tension(-2000), Velocity());
  EXPECT_TRUE(one.orientation.isOn());
  EXPECT_EQ(one.output(), Tension(-1999));  // 8.33 %
}

}  // namespace
}  // namespace wr::test
