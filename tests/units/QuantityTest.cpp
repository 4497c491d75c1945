#include <gtest/gtest.h>

#include <array>
#include <concepts>
#include <cstdint>
#include <limits>
#include <optional>

#include "support/difference.hpp"
#include "units/Measurements.hpp"
#include "units/SetPoints.hpp"
#include "units/quantities.hpp"

namespace wr {
namespace {

/// @brief Arithmetic with quantities of the same unit is possible. The result has this unit.
/// @verifies NFR-11
TEST(Quantity, Computes) {
  EXPECT_EQ(Velocity(30) + Velocity(12), Velocity(42));
  EXPECT_EQ(Velocity(30) - Velocity(12), Velocity(18));
  EXPECT_EQ(-Velocity(30), Velocity(-30));
  EXPECT_EQ(Velocity(30) * 2, Velocity(60));
  EXPECT_EQ(Velocity(-7) / 2, Velocity(-3));
  EXPECT_LT(Velocity(-1), Velocity());
  EXPECT_TRUE((std::same_as<decltype(Velocity(1) + Velocity(1)), Velocity>));
  EXPECT_TRUE((std::same_as<decltype(Velocity(1) * 2), Velocity>));
}

/// @brief The number of edges between two positions of a wheel is exact, also if the position has
/// continued at the other end of its range.
/// @verifies FR-177
TEST(HallCount, FR177_EdgesAreCountedAcrossTheEndOfTheRange) {
  using Limits = std::numeric_limits<std::int32_t>;
  constexpr HallCount kLast(Limits::max());
  constexpr HallCount kFirst(Limits::min());
  static_assert(edgesBetween(kLast, kFirst) == HallCount(1));
  static_assert(edgesBetween(kFirst, kLast) == HallCount(-1));
  static_assert(edgesBetween(HallCount(-3), HallCount(4)) == HallCount(7));
  EXPECT_EQ(edgesBetween(HallCount(4), HallCount(-3)), HallCount(-7));
}

template <class A, class B>
concept Mix = requires(A a, B b) { a + b; } || requires(A a, B b) { a - b; } || requires(A a, B b) {
  a < b;
} || requires(A a, B b) { a == b; } || requires(A a, B b) { a = b; } || std::convertible_to<B, A>;

/// The number of types B that can be combined with A.
template <class A, class... B>
constexpr int mixed() {
  return (0 + ... + (Mix<A, B> ? 1 : 0));
}

/// The number of pairs of types that can be combined. A pair may have the same type twice.
template <class... Types>
constexpr int mixedPairs() {
  return (0 + ... + mixed<Types, Types...>());
}

/// @brief Each unit can be combined only with itself, and not with a plain number. All pairs of
/// units are tested.
/// @verifies NFR-11
TEST(Quantity, NFR11_NoTwoUnitsMix) {
  EXPECT_EQ((mixedPairs<Velocity, Tension, Current, Angle, StepRate, HallCount, DutyCycle,
                        Microseconds>()),
            8);
  EXPECT_EQ(
      (mixed<std::int32_t, Velocity, Tension, Current, Angle, StepRate, HallCount, DutyCycle>()),
      0);
  EXPECT_EQ(
      (mixed<std::int16_t, Velocity, Tension, Current, Angle, StepRate, HallCount, DutyCycle>()),
      0);
  EXPECT_EQ((mixed<Instant, Velocity, Tension, Current, Angle, StepRate, HallCount, DutyCycle>()),
            0);
  EXPECT_FALSE((Mix<Velocity, std::int32_t> || Mix<Tension, std::int32_t> ||
                Mix<Current, std::int32_t> || Mix<Angle, std::int32_t> ||
                Mix<StepRate, std::int32_t> || Mix<HallCount, std::int32_t> ||
                Mix<DutyCycle, std::int32_t>));
}

/// @brief Arithmetic with instants and durations is in microseconds. The compiler distinguishes the
/// two types.
/// @verifies NFR-11
TEST(Instant, Computes) {
  const Instant start(1000);
  EXPECT_EQ(start + milliseconds(2), Instant(3000));
  EXPECT_EQ(start + Microseconds(-1), Instant(999));
  EXPECT_EQ(Instant(999) - start, Microseconds(-1));
  EXPECT_GT(Instant(1001), start);
  EXPECT_FALSE((std::equality_comparable_with<Instant, Microseconds>));
  EXPECT_FALSE((std::assignable_from<Instant&, Microseconds>));
  EXPECT_FALSE((std::assignable_from<Microseconds&, Instant>));
}

template <class Value>
concept SetsVelocity = requires(Value value) { WheelSetPoint::velocity(value); };

template <class Value>
concept SetsTension = requires(Value value) { WheelSetPoint::tension(value); };

template <class Value>
concept SetsCurrent = requires(Value value) { WheelSetPoint::current(value); };

/// @brief A set-point of a wheel can be constructed only from a value with the unit of its
/// quantity.
/// @verifies NFR-11
TEST(WheelSetPoint, NFR11_IsMadeOfItsOwnUnit) {
  EXPECT_EQ(WheelSetPoint::velocity(Velocity(-3000)),
            (WheelSetPoint{WheelQuantity::Velocity, -3000}));
  EXPECT_EQ(WheelSetPoint::tension(Tension(24000)), (WheelSetPoint{WheelQuantity::Tension, 24000}));
  EXPECT_EQ(WheelSetPoint::current(Current(-10000)),
            (WheelSetPoint{WheelQuantity::Current, -10000}));
  EXPECT_TRUE((SetsVelocity<Velocity> && SetsTension<Tension> && SetsCurrent<Current>));
  EXPECT_FALSE((SetsVelocity<Tension> || SetsVelocity<Current> || SetsVelocity<std::int16_t>));
  EXPECT_FALSE((SetsTension<Velocity> || SetsTension<Current> || SetsTension<std::int16_t>));
  EXPECT_FALSE((SetsCurrent<Velocity> || SetsCurrent<Tension> || SetsCurrent<std::int16_t>));
}

/// @brief A set-point of a wheel is read in the unit of its quantity.
/// @verifies NFR-11
TEST(WheelSetPoint, NFR11_IsReadInItsUnit) {
  EXPECT_EQ((WheelSetPoint{WheelQuantity::Velocity, -3000}).velocity(), Velocity(-3000));
  EXPECT_EQ((WheelSetPoint{WheelQuantity::Tension, 24000}).tension(), Tension(24000));
  EXPECT_EQ((WheelSetPoint{WheelQuantity::Current, -10000}).current(), Current(-10000));
  EXPECT_TRUE((std::same_as<decltype(WheelSetPoint().velocity()), Velocity>));
  EXPECT_TRUE((std::same_as<decltype(WheelSetPoint().tension()), Tension>));
  EXPECT_TRUE((std::same_as<decltype(WheelSetPoint().current()), Current>));
}

/// @brief Set-points are equal only when all their values are equal.
TEST(SetPoints, DifferInEachValue) {
  test::expectDifference(&WheelSetPoint::quantity, WheelQuantity::Current, &WheelSetPoint::value,
                         std::int16_t{1});
  test::expectDifference(
      &SetPoints::orderId, std::uint16_t{1}, &SetPoints::steering, Angle(1), &SetPoints::wheels,
      std::array<WheelSetPoint, kWheelCount>{WheelSetPoint{WheelQuantity::Velocity, 1}});
}

/// @brief Measurements and outputs are equal only when all their values are equal. A value of zero
/// is not equal to a missing value.
/// @verifies FR-62
TEST(Measurements, FR62_ZeroIsNotMissing) {
  WheelMeasurements wheel;
  wheel.velocity = Velocity(0);
  test::expectDifference(&WheelMeasurements::velocity, Velocity(0), &WheelMeasurements::current,
                         Current(0), &WheelMeasurements::position, HallCount(0));
  test::expectDifference(&Measurements::wheels, std::array<WheelMeasurements, kWheelCount>{wheel},
                         &Measurements::steering, Angle(0));
  test::expectDifference(&Outputs::tensions,
                         std::array<std::optional<Tension>, kWheelCount>{Tension(0)},
                         &Outputs::turn, std::int8_t{0});
}

}  // namespace
}  // namespace wr
