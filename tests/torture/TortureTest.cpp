#include <gtest/gtest.h>

#include <cstdint>
#include <iostream>
#include <string>

#include "support/seed.hpp"
#include "torture/Comparison.hpp"
#include "torture/Qemu.hpp"
#include "torture/VirtualProcessor.hpp"

namespace wr::torture {
namespace {

constexpr std::uint32_t kActions = 3000;
constexpr std::size_t kFewestEvents =
    25'000;  // in each run; the four runs with fixed seeds together have at least 100,000

/// @brief Runs random exceptions on the processor of the virtual K64 and on the processor of QEMU.
class TortureTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!Qemu::installed()) {
      GTEST_SKIP()
          << "qemu-system-arm is not installed, so there is no second processor to compare with";
    }
  }

  // Adds the number of comparisons to the result of the test.
  void TearDown() override {
    if (compared_ != 0) {
      RecordProperty("measured", std::to_string(compared_) + " entries and exits compared");
    }
  }

  void expectSameOnBoth(std::uint32_t seed) {
    const Image program = image(seed, kActions);
    const Records ours = VirtualProcessor::run(program);
    const Records theirs = Qemu::run(program);
    const auto difference = firstDifference(ours, theirs);
    EXPECT_EQ(difference, std::nullopt) << "seed " << seed << ", left: virtual K64, right: QEMU\n"
                                        << context(ours, theirs, difference.value_or(0));
    EXPECT_EQ(failedChecks(ours), "") << "seed " << seed;
    EXPECT_TRUE(complete(ours)) << "seed " << seed;
    EXPECT_GE(exceptionEvents(ours), kFewestEvents) << "seed " << seed;
    std::cout << exceptionEvents(ours) << " entries and exits with seed " << seed << "\n";
    compared_ += exceptionEvents(ours);
  }

 private:
  std::size_t compared_ = 0;
};

/// @brief For fixed seeds, the exceptions of both processors occur in the same order, with the same
/// preserved registers, the same masks and the same state of the interrupt controller.
TEST_F(TortureTest, ExceptionsAreTheSameAsOnQemuForFixedSeeds) {
  for (const std::uint32_t seed : {1U, 2U, 3U, 4U}) {
    expectSameOnBoth(seed);
  }
}

/// @brief The comparison is repeated with a new seed in each run.
TEST_F(TortureTest, ExceptionsAreTheSameAsOnQemuForAFreshSeed) {
  expectSameOnBoth(test::seed());
}

}  // namespace
}  // namespace wr::torture
