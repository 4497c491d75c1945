#include "wheel_control/algorithms/PiRegulator.hpp"

#include <gtest/gtest.h>

#include <cstddef>

namespace wr::test {
namespace {

class PiRegulatorTest : public testing::Test {
 protected:
  PiRegulator regulator{{.proportional = 3000, .integral = 500}};
};

/// @brief The voltage is a multiple of the error plus a fraction of the sum of all errors. This sum
/// includes the present error.
/// @verifies FR-83
TEST_F(PiRegulatorTest, FR83_AddsErrorAndSumOfErrors) {
  EXPECT_EQ(regulator.regulate(100), Tension(350));
  EXPECT_EQ(regulator.regulate(100), Tension(400));
  EXPECT_EQ(regulator.regulate(0), Tension(100));
  EXPECT_EQ(regulator.regulate(-200), Tension(-600));
}

/// @brief Fractions of a millivolt are not lost: two parts of 500 uV raise the integral by 1 mV.
/// @verifies FR-83
TEST_F(PiRegulatorTest, FR83_KeepsFractions) {
  PiRegulator integral({.proportional = 0, .integral = 500});
  EXPECT_EQ(integral.regulate(1), Tension(0));
  EXPECT_EQ(integral.regulate(1), Tension(1));
  EXPECT_EQ(integral.regulate(-1), Tension(0));
  EXPECT_EQ(integral.regulate(-1), Tension(0));
}

/// @brief Neither a positive nor a negative integral exceeds the supply voltage.
/// @verifies FR-301
TEST_F(PiRegulatorTest, FR301_IntegralStaysWithinTheSupply) {
  for (int cycle = 0; cycle < 10; ++cycle) {
    regulator.regulate(65535);
  }
  EXPECT_EQ(regulator.regulate(0), Tension(24000));
  for (int cycle = 0; cycle < 10; ++cycle) {
    regulator.regulate(-65535);
  }
  EXPECT_EQ(regulator.regulate(0), Tension(-24000));
}

/// @brief The missing voltage is the part of the demanded voltage that was not applied. If the
/// missing voltage explains an error, this error is not added to the integral. An error with the
/// opposite sign is added.
/// @verifies FR-301
TEST_F(PiRegulatorTest, FR301_ExplainedErrorIsNotKept) {
  regulator.regulate(1000);
  regulator.missed(Tension(400));
  EXPECT_EQ(regulator.regulate(100), Tension(300 + 500));
  EXPECT_EQ(regulator.regulate(-100), Tension(-300 + 450));
  regulator.missed(Tension(-400));
  EXPECT_EQ(regulator.regulate(-100), Tension(-300 + 450));
  EXPECT_EQ(regulator.regulate(100), Tension(300 + 500));
  regulator.missed(Tension());
  EXPECT_EQ(regulator.regulate(-100), Tension(-300 + 450));
}

/// @brief A missing voltage of less than 0.1 V does not explain an error. While a small demand
/// waits for a change of orientation, the integral can therefore still raise this demand.
/// @verifies FR-301
TEST_F(PiRegulatorTest, FR301_SlightShortfallExplainsNothing) {
  regulator.missed(Tension(99));
  EXPECT_EQ(regulator.regulate(100), Tension(300 + 50));
  regulator.missed(Tension(100));
  EXPECT_EQ(regulator.regulate(100), Tension(300 + 50));
  regulator.missed(Tension(-99));
  EXPECT_EQ(regulator.regulate(-100), Tension(-300));
  regulator.missed(Tension(-100));
  EXPECT_EQ(regulator.regulate(-100), Tension(-300));
}

/// @brief If a voltage is missing, even an error of 1 is not added to the integral.
/// @verifies FR-301
TEST_F(PiRegulatorTest, FR301_LeastErrorIsExplained) {
  for (const int sign : {1, -1}) {
    PiRegulator integral({.proportional = 0, .integral = 1000});
    integral.missed(Tension(sign * 100));
    EXPECT_EQ(integral.regulate(sign), Tension(0));
    integral.missed(Tension());
    EXPECT_EQ(integral.regulate(sign), Tension(sign));
  }
}

/// @brief A changed bit in the memory of the integral has no effect.
/// @verifies FR-224
TEST(PiRegulatorMemory, FR224_OneBitIsCorrected) {
  PiRegulator regulator({.proportional = 0, .integral = 1000});
  regulator.regulate(3000);
  auto* const bytes = reinterpret_cast<unsigned char*>(&regulator);
  for (std::size_t bit = sizeof(PiGains) * 8; bit < sizeof(PiGains) * 8 + 3 * 32; ++bit) {
    bytes[bit / 8] ^= static_cast<unsigned char>(1U << bit % 8);
    EXPECT_EQ(regulator.regulate(0), Tension(3000)) << bit;
  }
}

/// @brief A call of reset() clears the errors and the missing voltage.
/// @verifies FR-301
TEST_F(PiRegulatorTest, FR301_ResetForgets) {
  regulator.regulate(1000);
  regulator.missed(Tension(400));
  regulator.reset();
  EXPECT_EQ(regulator.regulate(100), Tension(350));
}

/// @brief A call of reset() leaves no fraction of a millivolt.
/// @verifies FR-301
TEST(PiRegulatorReset, FR301_ResetLeavesNoFraction) {
  PiRegulator integral({.proportional = 0, .integral = 999});
  integral.regulate(1000);
  integral.reset();
  EXPECT_EQ(integral.regulate(1), Tension(0));
}

}  // namespace
}  // namespace wr::test
