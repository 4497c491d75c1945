#include "wheel_control/algorithms/TensionAlgorithm.hpp"

#include <gtest/gtest.h>

namespace wr::test {
namespace {

/// @brief The voltage is the set-point, independent of measured and applied values.
/// @verifies FR-80
TEST(TensionAlgorithmTest, FR80_TensionIsTheSetPoint) {
  TensionAlgorithm algorithm;
  const WheelFeedback feedback{.velocity = Velocity(1234), .current = Current(-567)};
  for (const int value : {-24000, -1, 0, 1, 24000}) {
    const auto setPoint = static_cast<std::int16_t>(value);
    EXPECT_EQ(algorithm.calculate(setPoint, feedback), Tension(value));
    algorithm.applied(Tension());
    algorithm.reset();
  }
}

}  // namespace
}  // namespace wr::test
