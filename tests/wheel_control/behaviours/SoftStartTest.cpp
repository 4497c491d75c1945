#include "wheel_control/behaviours/SoftStart.hpp"

#include <gtest/gtest.h>

#include "wheel_control/behaviours/Advance.hpp"
#include "wheel_control/behaviours/SpyCommand.hpp"

namespace wr::test {
namespace {

class SoftStartTest : public testing::Test, protected SpiedCommands {
 protected:
  Tension apply(int demand) { return softStart.apply(Tension(demand), Velocity()); }

  Advance advance{setTension};
  SoftStart softStart{advance};
};

/// @brief The voltage rises by at most 12 V per cycle until it reaches the demand.
/// @verifies FR-81
TEST_F(SoftStartTest, FR81_RisesStepByStep) {
  EXPECT_EQ(apply(24000), Tension(12000));
  EXPECT_EQ(apply(24000), Tension(24000));
  EXPECT_EQ(apply(24000), Tension(24000));
  EXPECT_EQ(log, (CommandLog{{"tension", 12000}, {"tension", 24000}, {"tension", 24000}}));
}

/// @brief Backwards, the magnitude of the voltage rises by at most 12 V per cycle.
/// @verifies FR-81
TEST_F(SoftStartTest, FR81_MagnitudeRisesStepByStep) {
  EXPECT_EQ(apply(-20000), Tension(-12000));
  EXPECT_EQ(apply(-20000), Tension(-20000));
}

/// @brief A lower voltage is applied immediately. The next rise begins at this voltage.
/// @verifies FR-81
TEST_F(SoftStartTest, FR81_FallPassesAtOnce) {
  apply(12000);
  apply(24000);
  EXPECT_EQ(apply(1000), Tension(1000));
  EXPECT_EQ(apply(24000), Tension(13000));
}

/// @brief When the sign of the demand changes, the voltage starts again from 0.
/// @verifies FR-81
TEST_F(SoftStartTest, FR81_FlipStartsAgain) {
  apply(12000);
  apply(24000);
  EXPECT_EQ(apply(-24000), Tension(-12000));
  EXPECT_EQ(apply(24000), Tension(12000));
}

/// @brief If another behaviour has applied a voltage, the rise begins at this voltage.
/// @verifies FR-81
TEST_F(SoftStartTest, FR81_RisesFromWhatAnotherBehaviourApplied) {
  softStart.resume(Tension(5000));
  EXPECT_EQ(apply(24000), Tension(17000));
}

/// @brief If one SoftStart wraps another SoftStart, both begin at the voltage that a different
/// behaviour has applied.
/// @verifies FR-81
TEST_F(SoftStartTest, FR81_EachDecoratorBeginsAtTheVoltage) {
  SoftStart outer(static_cast<WheelBehaviour&>(softStart));
  outer.resume(Tension(5000));
  EXPECT_EQ(outer.apply(Tension(24000), Velocity()), Tension(17000));
}

/// @brief Without decorators, the behaviour Advance applies the demand immediately.
/// @verifies FR-80
TEST_F(SoftStartTest, FR80_AdvanceAppliesAtOnce) {
  advance.resume(Tension(1000));
  EXPECT_EQ(advance.apply(Tension(24000), Velocity()), Tension(24000));
  EXPECT_EQ(log, (CommandLog{{"tension", 24000}}));
}

}  // namespace
}  // namespace wr::test
