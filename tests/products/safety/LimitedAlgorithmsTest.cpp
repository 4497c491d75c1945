#include <gtest/gtest.h>

#include <optional>

#include "safety/CurrentLimited.hpp"
#include "safety/LimitedAlgorithms.hpp"
#include "safety/SpeedLimited.hpp"
#include "wheel_control/ControlledWheel.hpp"

namespace wr::test {
namespace {

/// An algorithm that records its calls. Its voltage is its set-point in mV.
class DirectAlgorithm final : public WheelAlgorithm {
 public:
  Tension calculate(std::int16_t setPoint, const WheelFeedback& /*feedback*/) override {
    return Tension(setPoint);
  }
  void applied(Tension tension) override { voltage = tension; }
  void reset() override { ++resets; }

  Tension voltage;
  int resets = 0;
};

WheelFeedback measured(int rpm, int milliamperes, std::optional<Tension> applied = std::nullopt) {
  return {.velocity = Velocity(10 * rpm), .current = Current(milliamperes), .applied = applied};
}

/// @brief The voltage of a wheel rises by at most 1 V for each ampere below 12 A, because the
/// winding has more than 1 ohm. At 12 A, the voltage does not rise. At 14 A, it falls by 2 V. The
/// other direction has the same limits. A demand below the limit is not changed. While the voltage
/// of the wheel is unknown, no demand is changed.
/// @verifies FR-296
TEST(CurrentLimitedTest, FR296_TheCurrentStaysBelowTheTrip) {
  DirectAlgorithm direct;
  CurrentLimited limited(direct);
  EXPECT_EQ(limited.calculate(24000, measured(0, 12000)), Tension(24000));
  for (const int sign : {1, -1}) {
    const auto next = [&](int ordered, int amperes) {
      return limited.calculate(static_cast<std::int16_t>(sign * ordered),
                               measured(50, sign * 1000 * amperes, Tension(sign * 6000)));
    };
    EXPECT_EQ(next(20000, 12), Tension(sign * 6000));
    EXPECT_EQ(next(20000, 10), Tension(sign * 8000));
    EXPECT_EQ(next(20000, 14), Tension(sign * 4000));
    EXPECT_EQ(next(7999, 10), Tension(sign * 7999));
    EXPECT_EQ(next(0, 11), Tension(0));
  }
  limited.applied(Tension(6000));
  EXPECT_EQ(direct.voltage, Tension(6000));
  limited.reset();
  EXPECT_EQ(direct.resets, 1);
}

/// @brief A wheel that was halted, or whose measurement was missing for one cycle, still has a known
/// voltage. The limit of the current begins at this voltage. The same is true after a change of the
/// ordered quantity. Without a known voltage there is no limit.
/// @verifies FR-296
TEST(CurrentLimitedTest, FR296_AKnownVoltageIsNotForgotten) {
  ControlledWheel parts;
  LimitedAlgorithms algorithms;
  WheelController controller({.velocity = parts.velocities,
                              .current = parts.currents,
                              .timebase = parts.time,
                              .algorithms = algorithms.all(),
                              .advance = parts.reverse,
                              .stop = parts.stop,
                              .stopWheel = parts.stopWheel});
  const auto control = [&](const WheelSetPoint& setPoint, std::optional<Current> current) {
    parts.measure(Velocity(300), current.value_or(Current()));
    parts.position = parts.position + HallCount(2);
    controller.control(setPoint,
                       {.velocity = Velocity(300), .current = current, .position = parts.position});
    return controller.applied().value_or(Tension());
  };
  EXPECT_GT(control(velocityOf(3000), Current(12000)), Tension(10000));
  const Tension known = control(velocityOf(3000), Current(12000));
  const Tension lowered = control(velocityOf(3000), std::nullopt);
  EXPECT_EQ(lowered, known - Tension(2400));
  EXPECT_EQ(control(velocityOf(3000), Current(9600)), known);
  controller.halt();
  EXPECT_EQ(controller.applied(), lowered);
  EXPECT_EQ(control(velocityOf(3000), Current(9600)), known);
  const Tension ofTension = control(tensionOf(24000), Current(12000));
  EXPECT_LT(ofTension, known);
  EXPECT_EQ(control(velocityOf(3000), Current(10000)), ofTension + Tension(2000));
}

/// @brief At the limit of 290 rpm, the voltage of a wheel does not rise. Above this limit, the
/// voltage falls. A wheel that accelerates towards the limit gets less voltage than a wheel with a
/// constant velocity. An order against the motion is not changed.
/// @verifies FR-283
TEST(SpeedLimitedTest, FR283_TheLimitBeginsAtTheVoltageOfTheWheel) {
  for (const int sign : {1, -1}) {
    DirectAlgorithm direct;
    SpeedLimited limited(direct);
    const auto demand = static_cast<std::int16_t>(sign * 24000);
    const auto next = [&](int rpm) {
      const Tension result = limited.calculate(demand, measured(sign * rpm, 0));
      limited.applied(Tension(sign * 10000));
      return sign * result.count();
    };
    next(290);
    EXPECT_EQ(next(290), 10000);
    EXPECT_LT(next(300), 10000);
    EXPECT_LT(next(300), 10000);
    EXPECT_GT(next(280), 10000);
    const std::int32_t steady = next(280);
    EXPECT_GT(steady, 10000);
    next(260);
    EXPECT_LT(next(280), steady);
    EXPECT_EQ(limited.calculate(static_cast<std::int16_t>(-sign * 1000), measured(sign * 280, 0)),
              Tension(-sign * 1000));
    limited.reset();
    EXPECT_EQ(direct.resets, 1);
  }
}

/// @brief The wrapped algorithm gets the applied voltage. After a call of reset(), the voltage and
/// the previous velocity are unknown, as at the start.
/// @verifies FR-283
TEST(SpeedLimitedTest, FR283_AResetForgetsVoltageAndVelocity) {
  DirectAlgorithm direct;
  SpeedLimited limited(direct);
  const Tension first = limited.calculate(24000, measured(290, 0));
  limited.applied(Tension(4000));
  EXPECT_EQ(direct.voltage, Tension(4000));
  limited.calculate(24000, measured(200, 0));
  limited.reset();
  EXPECT_EQ(limited.calculate(24000, measured(290, 0)), first);
}

/// @brief At 290 rpm, the velocity of a wheel induces 15.2 V. If the voltage of the wheel is
/// unknown, the algorithm sets a voltage that is too low to drive the wheel, even with a supply of
/// 29 V instead of 24 V.
/// @verifies FR-283
TEST(SpeedLimitedTest, FR283_AnUnknownVoltageIsTakenForLow) {
  DirectAlgorithm direct;
  SpeedLimited limited(direct);
  const Tension first = limited.calculate(24000, measured(290, 0));
  EXPECT_LT(first.count() * 29 / 24, 15200);
  EXPECT_GT(first.count(), 10000);
}

}  // namespace
}  // namespace wr::test
