#include "wheel_control/behaviours/Stop.hpp"

#include <gtest/gtest.h>

#include "wheel_control/behaviours/SpyCommand.hpp"

namespace wr::test {
namespace {

class StopTest : public testing::Test, protected SpiedCommands {
 protected:
  static constexpr int kFall = 2400;  // [mV per cycle]
  Stop stop{setTension, stopWheel};
};

/// @brief The behaviour Stop lowers the voltage by 2.4 V per cycle. At 0 V, the command StopWheel
/// is executed.
/// @verifies FR-88
TEST_F(StopTest, FR88_TensionFallsStepByStep) {
  Tension applied(6000);
  for (int cycle = 0; cycle < 4; ++cycle) {
    applied = stop.apply(applied, Velocity(1000));
  }
  EXPECT_EQ(
      log,
      (CommandLog{
          {"tension", 6000 - kFall}, {"tension", 6000 - 2 * kFall}, {"stop", 0}, {"stop", 0}}));
}

/// @brief If the wheel turns backwards, the magnitude of the voltage also falls by 2.4 V per cycle.
/// @verifies FR-88
TEST_F(StopTest, FR88_MagnitudeFallsBackwards) {
  EXPECT_EQ(stop.apply(Tension(-3000), Velocity(-1000)), Tension(-3000 + kFall));
  EXPECT_EQ(stop.apply(Tension(-600), Velocity(-1000)), Tension(0));
  EXPECT_EQ(log, (CommandLog{{"tension", -600}, {"stop", 0}}));
}

/// @brief resume() gets the voltage of another behaviour. This voltage has no effect, because each
/// call of apply() gets the present voltage.
/// @verifies FR-88
TEST_F(StopTest, FR88_StartsFromWhatItIsTold) {
  stop.resume(Tension(20000));
  EXPECT_EQ(stop.apply(Tension(5000), Velocity()), Tension(2600));
}

}  // namespace
}  // namespace wr::test
