#include <gtest/gtest.h>

#include <concepts>

#include "units/quantities.hpp"

namespace wr {
namespace {

/// @brief Quantities of one unit can be computed with.
TEST(Quantity, Computes) {
  EXPECT_EQ(Velocity(30) + Velocity(12), Velocity(42));
  EXPECT_EQ(Velocity(30) - Velocity(12), Velocity(18));
  EXPECT_EQ(-Velocity(30), Velocity(-30));
  EXPECT_EQ(Velocity(30) * 2, Velocity(60));
  EXPECT_EQ(Velocity(-7) / 2, Velocity(-3));
  EXPECT_LT(Velocity(-1), Velocity());
}

/// @brief Quantities of different units do not mix.
TEST(Quantity, DoesNotMixUnits) {
  EXPECT_FALSE((std::equality_comparable_with<Velocity, Current>));
  EXPECT_FALSE((std::convertible_to<std::int32_t, Velocity>));
}

/// @brief Instants and durations are computed with in microseconds.
TEST(Instant, Computes) {
  const Instant start(1000);
  EXPECT_EQ(start + milliseconds(2), Instant(3000));
  EXPECT_EQ(start + Microseconds(-1), Instant(999));
  EXPECT_EQ(Instant(999) - start, Microseconds(-1));
  EXPECT_GT(Instant(1001), start);
}

}  // namespace
}  // namespace wr
