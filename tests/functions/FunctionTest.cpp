#include "functions/Function.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <random>

#include "functions/HallVelocity.hpp"
#include "functions/RcDirection.hpp"
#include "functions/RcVelocity.hpp"
#include "functions/SampledAngle.hpp"
#include "functions/SampledCurrent.hpp"
#include "functions/scaling.hpp"
#include "support/seed.hpp"

namespace wr::test {
namespace {

constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
constexpr std::int32_t kLeast = std::numeric_limits<std::int32_t>::min();

/// Arguments for a function under test. Each argument may be missing.
struct Given : Arguments {
  virtual ~Given() = default;

  void fill(ArgumentValues& filled) const override {
    for (std::size_t id = 0; id < values.size(); ++id) {
      if (values[id]) {
        filled.set(static_cast<ArgumentId>(id), *values[id]);
      }
    }
  }

  Given& with(ArgumentId id, std::optional<std::int32_t> number) {
    values.at(static_cast<std::size_t>(id)) = number;
    return *this;
  }

  Given(std::int32_t raw, std::int32_t elapsed, std::int32_t scale, std::int32_t divisor,
        std::int32_t offset)
      : values{raw, elapsed, scale, divisor, offset, std::nullopt, std::nullopt} {}

  std::array<std::optional<std::int32_t>, 7> values;
};

/// @brief Velocity is edges * scale / (divisor * time), rounded to the nearest number.
/// @verifies FR-120
TEST(Function, FR120_HallVelocity) {
  const HallVelocity function;
  EXPECT_EQ(function.calculate(Given(30, 100'000, 600'000'000, 60, 0)), 3000);
  EXPECT_EQ(function.calculate(Given(-30, 100'000, 600'000'000, 60, 0)), -3000);
  EXPECT_EQ(function.calculate(Given(1, 200'000, 600'000'000, 60, 0)), 50);
  EXPECT_EQ(function.calculate(Given(0, 1, 600'000'000, 60, 0)), 0);
  EXPECT_EQ(function.calculate(Given(1, 3, 5, 1, 0)), 2);
  EXPECT_EQ(function.calculate(Given(-1, 2, 5, 1, 0)), -3);
}

/// @brief The velocity has no value when the time is 0.
/// @verifies FR-120
TEST(Function, FR120_HallVelocityNeedsTime) {
  EXPECT_FALSE(HallVelocity().calculate(Given(1, 0, 600'000'000, 60, 0)));
}

/// @brief A velocity at the bounds is valid. A velocity beyond the bounds is invalid.
/// @verifies FR-124
TEST(Function, FR124_HallVelocityIsBounded) {
  const HallVelocity function;
  for (const std::int32_t sign : {1, -1}) {
    Given arguments(sign, 1, 4500, 1, 0);
    arguments.with(ArgumentId::Lowest, -4500).with(ArgumentId::Highest, 4500);
    EXPECT_EQ(function.calculate(arguments), sign * 4500);
    EXPECT_FALSE(function.calculate(arguments.with(ArgumentId::Scale, 4501)));
  }
}

/// @brief Current is (sum - offset) * scale / divisor. A current beyond its bounds is rejected.
/// @verifies FR-125
TEST(Function, FR125_SampledCurrent) {
  const SampledCurrent function;
  Given arguments(100 * 124, 100'000, 33000, 4096 * 100, 0);
  EXPECT_EQ(function.calculate(arguments), 999);
  arguments.with(ArgumentId::Lowest, -999).with(ArgumentId::Highest, 999);
  EXPECT_EQ(function.calculate(arguments), 999);
  EXPECT_FALSE(function.calculate(arguments.with(ArgumentId::Highest, 998)));
  EXPECT_EQ(function.calculate(Given(-2, 0, 10, 8, 2)), -5);
}

/// @brief Angle is (sum - offset) * scale / divisor, rounded to the nearest number.
/// @verifies FR-129
TEST(Function, FR129_SampledAngle) {
  const SampledAngle function;
  Given arguments(8 * 82, 8000, 8000, 8 * 4096, 8 * 2048);
  EXPECT_EQ(function.calculate(arguments), -3840);
  EXPECT_EQ(function.calculate(arguments.with(ArgumentId::Raw, 8 * 4013)), 3838);
  EXPECT_EQ(function.calculate(arguments.with(ArgumentId::Raw, 8 * 2048)), 0);
  EXPECT_EQ(function.calculate(arguments.with(ArgumentId::Raw, 8 * 2048 + 2)), 0);
  EXPECT_EQ(function.calculate(arguments.with(ArgumentId::Raw, 8 * 2048 - 3)), -1);
}

/// Arguments of a pulse of the remote control.
struct Pulse final : Given {
  explicit Pulse(std::int32_t width) : Given(width, 20'000, 3000, 500, 1500) {
    with(ArgumentId::Lowest, 900).with(ArgumentId::Highest, 2100);
  }
};

template <class Lever>
class LeverFunction : public testing::Test {
 protected:
  Lever function;
};

using Levers = testing::Types<RcVelocity, RcDirection>;
TYPED_TEST_SUITE(LeverFunction, Levers);

/// @brief The value of a pulse is proportional to the difference between the width of the pulse and
/// the width at the centre of the stick.
/// @verifies FR-52
TYPED_TEST(LeverFunction, FR52_InProportion) {
  for (std::int32_t width = 1000; width <= 2000; ++width) {
    if (std::abs(width - 1500) > 20) {
      EXPECT_EQ(this->function.calculate(Pulse(width)), (width - 1500) * 6);
    }
  }
}

/// @brief The value of a pulse is 0 if its width differs by at most 20 us from the width at the
/// centre of the stick.
/// @verifies FR-53
TYPED_TEST(LeverFunction, FR53_MiddleIsZero) {
  for (std::int32_t width = 1500 - 20; width <= 1500 + 20; ++width) {
    EXPECT_EQ(this->function.calculate(Pulse(width)), 0);
  }
  EXPECT_EQ(this->function.calculate(Pulse(1500 - 21)), -126);
  EXPECT_EQ(this->function.calculate(Pulse(1500 + 21)), 126);
}

/// @brief If a pulse is slightly beyond full deflection, it counts as full deflection. If it is far
/// beyond full deflection, it has no value.
/// @verifies FR-54
TYPED_TEST(LeverFunction, FR54_EndsOfTheLever) {
  for (const std::int32_t width : {900, 999, 1000}) {
    EXPECT_EQ(this->function.calculate(Pulse(width)), -3000);
  }
  for (const std::int32_t width : {2000, 2001, 2100}) {
    EXPECT_EQ(this->function.calculate(Pulse(width)), 3000);
  }
  for (const std::int32_t width : {0, 899, 2101, 20000}) {
    EXPECT_FALSE(this->function.calculate(Pulse(width)));
  }
}

/// @brief If a necessary argument is missing, a function returns no value. The bounds Lowest and
/// Highest may be missing.
/// @verifies FR-52
/// @verifies FR-120
/// @verifies FR-125
/// @verifies FR-129
TEST(Function, FR120_MissingArgument) {
  const HallVelocity velocity;
  const SampledCurrent current;
  const SampledAngle angle;
  const RcVelocity rcVelocity;
  const RcDirection rcDirection;
  const std::array<const Function*, 5> functions = {&velocity, &current, &angle, &rcVelocity,
                                                    &rcDirection};
  for (const Function* const function : functions) {
    const auto without = [&](ArgumentId missing, std::optional<std::int32_t> instead = {}) {
      Given arguments(1600, 20'000, 3000, 500, 1500);
      return function->calculate(arguments.with(missing, instead));
    };
    ASSERT_TRUE(without(ArgumentId::Lowest));
    for (const ArgumentId missing : {ArgumentId::Raw, ArgumentId::Scale, ArgumentId::Divisor}) {
      EXPECT_FALSE(without(missing));
    }
    const bool timed = function == &velocity;
    EXPECT_EQ(without(ArgumentId::Elapsed).has_value(), !timed);
    EXPECT_EQ(without(ArgumentId::Offset).has_value(), timed);
    EXPECT_FALSE(without(ArgumentId::Divisor, 0));
    EXPECT_FALSE(without(ArgumentId::Divisor, -1));
  }
}

/// @brief Arguments at the ends of their range never cause an overflow. The result is right, or it
/// is missing because it needs more than 32 bits.
/// @verifies FR-120
/// @verifies FR-125
TEST(Function, FR120_NoOverflow) {
  std::mt19937 random(seed());
  std::uniform_int_distribution<std::int32_t> any(kLeast, kMost);
  std::uniform_int_distribution<int> choice(0, 3);
  const auto number = [&] {
    switch (choice(random)) {
      case 0:
        return kLeast;
      case 1:
        return kMost;
      default:
        return any(random);
    }
  };
  for (int i = 0; i < 100'000; ++i) {
    const std::int32_t raw = number();
    const std::int32_t elapsed = std::max(0, number());
    const std::int32_t scale = number();
    const std::int32_t divisor = std::max(1, number());
    const std::int32_t offset = number();
    const Given arguments(raw, elapsed, scale, divisor, offset);
    const auto check = [&](std::optional<std::int32_t> result, long double exact) {
      if (result) {
        ASSERT_NEAR(static_cast<double>(*result), static_cast<double>(exact), 0.5001);
      } else {
        ASSERT_GT(std::abs(exact), 2147483647.0L);
      }
    };
    const auto product = static_cast<long double>(scale);
    check(HallVelocity().calculate(arguments),
          product * raw / static_cast<long double>(divisor) / static_cast<long double>(elapsed));
    check(SampledCurrent().calculate(arguments),
          (static_cast<long double>(raw) - offset) * product / divisor);
  }
}

/// @brief A quotient is rounded to the nearest number, and a half is rounded away from zero.
/// @verifies FR-125
TEST(Scaling, FR125_RoundsToNearest) {
  EXPECT_EQ(quotient(7, 2), 4);
  EXPECT_EQ(quotient(-7, 2), -4);
  EXPECT_EQ(quotient(6, 4), 2);
  EXPECT_EQ(quotient(5, 4), 1);
  EXPECT_EQ(quotient(-5, 4), -1);
  EXPECT_EQ(quotient(0, 4), 0);
  EXPECT_FALSE(quotient(1, 0));
  EXPECT_FALSE(quotient(1, -1));
  EXPECT_FALSE(quotient(std::int64_t{kMost} + 1, 1));
  EXPECT_EQ(quotient(std::int64_t{kLeast}, 1), kLeast);
  EXPECT_EQ(quotient(1, 2), 1);
  EXPECT_EQ(quotient(-1, 2), -1);
}

/// @brief quotient() also divides correctly when the divisor needs more than 31 bits.
/// @verifies FR-120
TEST(Scaling, FR120_LargeDivisor) {
  constexpr std::int64_t kDivisor = (std::int64_t{1} << 32) - 2;
  EXPECT_EQ(quotient(0, kDivisor), 0);
  EXPECT_EQ(quotient(kDivisor / 2, kDivisor), 1);
  EXPECT_EQ(quotient(-5 * kDivisor, kDivisor), -5);
}

/// @brief The range in which the value is 0 may have the width 0. Then even the smallest deflection
/// of a stick gives a value other than 0.
/// @verifies FR-52
TEST(Scaling, FR52_LeastDeflection) {
  for (const std::int32_t side : {-1, 0, 1}) {
    ArgumentValues values;
    Pulse(1500 + side).fill(values);
    EXPECT_EQ(deflected(values, 0), side * 6);
  }
}

}  // namespace
}  // namespace wr::test
