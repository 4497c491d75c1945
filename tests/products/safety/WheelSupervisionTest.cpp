#include "safety/WheelSupervision.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace wr::test {
namespace {

/// A wheel. A test sets its measurements. By default, voltage, velocity and current match. The
/// motor has 52.36 mV per rpm and 1.5 Ohm. At 150 rpm, the motor needs 7.854 V, and 1.5 V more for
/// a current of 1 A.
class SupervisedWheel : public testing::Test {
 protected:
  static WheelMeasurements measured(double rpm, double amperes) {
    WheelMeasurements values;
    values.velocity = Velocity(static_cast<std::int32_t>(std::lround(rpm * 10)));
    values.current = Current(static_cast<std::int32_t>(std::lround(amperes * 1000)));
    return values;
  }

  static WheelSetPoint velocity(double rpm) {
    return {.quantity = WheelQuantity::Velocity, .value = static_cast<std::int16_t>(rpm * 10)};
  }

  /// Runs a cycle. The voltage and the set-point apply until the next cycle.
  StopCause cycle(const WheelMeasurements& values, double volts, double setPoint) {
    const WheelSetPoint followed = velocity(setPoint);
    return wheel.examine(values, Tension(static_cast<std::int32_t>(volts * 1000)), &followed);
  }

  /// Repeats a cycle, with the noise of a current sensor. Returns the number of the first cycle
  /// with a cause of a stop; 0 if there is no such cycle.
  int firstCause(int cycles, WheelMeasurements values, double volts, double setPoint) {
    for (int number = 1; number <= cycles; ++number) {
      if (values.current) {
        *values.current = *values.current + Current(number % 2 == 0 ? 1 : -1);
      }
      cause = cycle(values, volts, setPoint);
      if (cause != StopCause::None) {
        return number;
      }
    }
    return 0;
  }

  /// Runs a cycle of a halted wheel. `volts` is the voltage that remains from an earlier cycle.
  StopCause halted(const WheelMeasurements& values, double volts = 0) {
    return wheel.examine(values, Tension(static_cast<std::int32_t>(volts * 1000)), nullptr);
  }

  /// Returns the difference between the voltage of the wheel and the voltage of the motor model
  /// [mV]. The induced voltage and the voltage at the winding are whole millivolts.
  static int difference(int millivolts, int rpm, int milliamperes) {
    const int induced = rpm * 5236 / 100;
    const int winding = milliamperes * 15 / 10;
    return millivolts - induced - winding;
  }

  WheelSupervision wheel;
  StopCause cause = StopCause::None;
};

/// @brief A wheel at 150 rpm is plausible when its voltage, velocity and current agree.
/// @verifies FR-277
TEST_F(SupervisedWheel, FR277_MatchingMeasurementsArePlausible) {
  EXPECT_EQ(firstCause(100, measured(150, 1), 9.354, 150), 0);
}

/// @brief The overcurrent trip, missing motion and a late reversal each cause a stop immediately,
/// even when the wheel is halted.
/// @verifies FR-273
TEST_F(SupervisedWheel, FR273_FaultsOfTheWheelAreCauses) {
  WheelMeasurements tripped = measured(0, 0);
  tripped.cutOff = true;
  EXPECT_EQ(halted(tripped), StopCause::Overcurrent);
  WheelMeasurements still = measured(0, 0);
  still.blind = true;
  EXPECT_EQ(halted(still), StopCause::NoMotion);
  WheelMeasurements late = measured(0, 0);
  late.reversalLate = true;
  EXPECT_EQ(halted(late), StopCause::Reversal);
  EXPECT_EQ(halted(measured(0, 0)), StopCause::None);
}

/// @brief A velocity of 330.0 rpm is permitted. A velocity of 330.1 rpm causes a stop in the same
/// cycle. This is true in both directions, and also for a halted wheel.
/// @verifies FR-274
TEST_F(SupervisedWheel, FR274_MoreThan330RpmIsACause) {
  EXPECT_EQ(halted(measured(330.0, 0)), StopCause::None);
  EXPECT_EQ(halted(measured(330.1, 0)), StopCause::Overspeed);
  wheel.reset();
  EXPECT_EQ(halted(measured(-330.0, 0)), StopCause::None);
  EXPECT_EQ(halted(measured(-330.1, 0)), StopCause::Overspeed);
}

/// @brief A motor has a voltage of 1.1 V, but turns its wheel at 5.1 rpm in the opposite direction.
/// This causes a stop in the second cycle. At 1.0 V or at 5.0 rpm, there is no stop.
/// @verifies FR-275
TEST_F(SupervisedWheel, FR275_TurningAgainstTheVoltageIsACause) {
  EXPECT_EQ(cycle(measured(0, 0), 1.1, 10), StopCause::None);
  EXPECT_EQ(cycle(measured(-5.1, 0.3), 1.1, 10), StopCause::None);
  EXPECT_EQ(cycle(measured(-5.1, 0.3), 1.1, 10), StopCause::WrongDirection);
  wheel.reset();
  EXPECT_EQ(firstCause(10, measured(-5.0, 0.3), 1.1, 10), 0);
  wheel.reset();
  EXPECT_EQ(firstCause(10, measured(-5.1, 0.3), 1.0, 10), 0);
  wheel.reset();
  EXPECT_EQ(firstCause(3, measured(5.1, -0.3), -1.1, -10), 3);
  EXPECT_EQ(cause, StopCause::WrongDirection);
}

/// @brief The wheel has 1.5 V and turns at 20 rpm in the opposite direction. The voltage of the
/// wheel may differ from the voltage of the motor model by up to the sum of two voltages: 40 % of
/// 1.5 V, and half of the induced voltage. A current of 0.96 A does not cause a stop. A current of
/// 0.93 A causes a stop in the second cycle.
/// @verifies FR-275
TEST_F(SupervisedWheel, FR275_TheCurrentShowsWhoTurnsTheWheel) {
  EXPECT_EQ(firstCause(20, measured(-20, 0.96), 1.5, 17.6), 0);
  EXPECT_EQ(firstCause(20, measured(-20, 0.93), 1.5, 17.6), 2);
  EXPECT_EQ(cause, StopCause::WrongDirection);
}

/// @brief At 1.501 V and at 20 rpm in the opposite direction, the bound in whole millivolts is
/// 1.123 V. At a current of 0.950 A, the difference to the motor model is exactly this bound, and
/// does not cause a stop. At 0.949 A, the difference is 1.125 V, and causes a stop.
/// @verifies FR-275
TEST_F(SupervisedWheel, FR275_TheBoundOfTheUnexplainedVoltageIsPermitted) {
  EXPECT_EQ(difference(1501, -20, 950), 1123);
  EXPECT_EQ(difference(1501, -20, 949), 1125);
  for (int number = 0; number < 4; ++number) {
    EXPECT_EQ(cycle(measured(-20, 0.950), 1.501, 17.6), StopCause::None);
  }
  wheel.reset();
  EXPECT_EQ(cycle(measured(-20, 0.949), 1.501, 17.6), StopCause::None);
  EXPECT_EQ(cycle(measured(-20, 0.949), 1.501, 17.6), StopCause::None);
  EXPECT_EQ(cycle(measured(-20, 0.949), 1.501, 17.6), StopCause::WrongDirection);
}

/// @brief A slope turns a wheel faster and faster, in the direction opposite to its voltage. The
/// wheel draws the current (3 V + k v) / 1.5 Ohm, with the motor constant k and the velocity v.
/// This does not cause a stop, even with 15 % more resistance and a supply of 21 V.
/// @verifies FR-275
TEST_F(SupervisedWheel, FR275_ADraggedWheelIsNoCause) {
  for (const double share : {1.0, 21.0 / 24 / 1.15}) {
    wheel.reset();
    EXPECT_EQ(halted(measured(-4, 2), 3.0), StopCause::None);
    for (double rpm = 6; rpm < 120; rpm += 3) {
      EXPECT_EQ(cycle(measured(-rpm, share * (3.0 + rpm * 0.05236) / 1.5), 3.0, 120),
                StopCause::None)
          << rpm;
    }
  }
}

/// @brief With swapped leads, a voltage of 3 V turns a wheel in the opposite direction. The current
/// is (3 V - k v) / 1.5 Ohm, with the motor constant k and the velocity v. This causes a stop.
/// @verifies FR-275
TEST_F(SupervisedWheel, FR275_SwappedLeadsAreACause) {
  EXPECT_EQ(cycle(measured(0, 2), 3.0, 30), StopCause::None);
  EXPECT_EQ(cycle(measured(-25, 1.13), 3.0, 30), StopCause::None);
  EXPECT_EQ(cycle(measured(-35, 0.78), 3.0, 30), StopCause::WrongDirection);
}

/// @brief A fault that is present in every second cycle is detected. Each cycle without the fault
/// lowers the count of the fault by only half a cycle. A fault in every third cycle is not
/// detected.
/// @verifies FR-275
TEST_F(SupervisedWheel, FR275_AnIntermittentFaultIsACause) {
  EXPECT_EQ(cycle(measured(0, 2), 3.0, 30), StopCause::None);
  EXPECT_EQ(cycle(measured(-30, 0.95), 3.0, 30), StopCause::None);
  EXPECT_EQ(cycle(measured(0, 2), 3.0, 30), StopCause::None);
  EXPECT_EQ(cycle(measured(-30, 0.95), 3.0, 30), StopCause::None);
  EXPECT_EQ(cycle(measured(0, 2), 3.0, 30), StopCause::None);
  EXPECT_EQ(cycle(measured(-30, 0.95), 3.0, 30), StopCause::WrongDirection);
  wheel.reset();
  for (int number = 0; number < 30; ++number) {
    const bool fault = number % 3 == 1;
    EXPECT_EQ(cycle(fault ? measured(-30, 0.95) : measured(0, 2), 3.0, 30), StopCause::None);
  }
}

/// @brief A velocity causes a stop in the third cycle if it exceeds the set-point by more than 40
/// rpm plus 25 % of the set-point.
/// @verifies FR-276
TEST_F(SupervisedWheel, FR276_FasterThanTheSetPointIsACause) {
  const double volts = 150 * 0.05236 + 1.5;
  constexpr double kPermitted = 100 + 40 + 0.25 * 100;  // [rpm]
  for (int settling = 0; settling < 5; ++settling) {
    EXPECT_EQ(cycle(measured(100, 1), volts, 100), StopCause::None);
  }
  EXPECT_EQ(firstCause(20, measured(kPermitted, 1), volts, 100), 0);
  EXPECT_EQ(firstCause(20, measured(kPermitted + 0.1, 1), volts, 100), 3);
  EXPECT_EQ(cause, StopCause::Overspeed);
}

/// @brief If a wheel is too fast backwards, this also causes a stop in the third cycle.
/// @verifies FR-276
TEST_F(SupervisedWheel, FR276_AWheelThatIsTooFastBackwardsIsACause) {
  const double volts = -150 * 0.05236 - 1.5;
  EXPECT_EQ(firstCause(20, measured(-165.0, -1), volts, -100), 0);
  EXPECT_EQ(firstCause(20, measured(-165.2, -1), volts, -100), 3);
  EXPECT_EQ(cause, StopCause::Overspeed);
}

/// @brief When a wheel begins to follow set-points, its velocity is not compared with the
/// set-points before the wheel has followed ten of them.
/// @verifies FR-276
TEST_F(SupervisedWheel, FR276_TheComparisonNeedsTenSetPoints) {
  EXPECT_EQ(firstCause(20, measured(250, 0), 250 * 0.05236, 17.6), 13);
  EXPECT_EQ(cause, StopCause::Overspeed);
}

/// @brief The velocity is compared with the greatest of the last ten set-points.
/// @verifies FR-276
TEST_F(SupervisedWheel, FR276_TheLastTenSetPointsCount) {
  const double volts = 150 * 0.05236 + 1.5;
  EXPECT_EQ(firstCause(20, measured(180, 1), volts, 150), 0);
  EXPECT_EQ(firstCause(20, measured(180, 1), volts, 100), 13);
  EXPECT_EQ(cause, StopCause::Overspeed);
}

/// @brief A wheel that is too fast, but loses more than 1 rpm in a cycle, is being braked. Such a
/// wheel does not cause a stop. A wheel that loses only 1 rpm causes a stop.
/// @verifies FR-276
TEST_F(SupervisedWheel, FR276_AWheelThatSlowsDownIsNoCause) {
  EXPECT_EQ(firstCause(10, measured(20, 1), 2.5, 20), 0);
  EXPECT_EQ(cycle(measured(100, 0), 5.2, 20), StopCause::None);
  EXPECT_EQ(cycle(measured(110, 0), 5.7, 20), StopCause::None);
  double noise = 0;
  for (double rpm = 108.9; rpm > 66; rpm -= 1.1) {
    noise = 0.001 - noise;
    EXPECT_EQ(cycle(measured(rpm, noise), rpm * 0.05236, 20), StopCause::None) << rpm;
  }
  wheel.reset();
  EXPECT_EQ(firstCause(10, measured(20, 1), 2.5, 20), 0);
  EXPECT_EQ(cycle(measured(100, 0), 5.2, 20), StopCause::None);
  EXPECT_EQ(cycle(measured(99, 0), 5.2, 20), StopCause::None);
  EXPECT_EQ(cycle(measured(98, 0), 5.2, 20), StopCause::Overspeed);
}

/// @brief A wheel does not cause a stop if it follows a falling set-point with a delay of four
/// cycles.
/// @verifies FR-276
TEST_F(SupervisedWheel, FR276_BrakingIsNoCause) {
  std::vector<double> setPoints;
  for (int number = 0; number < 40; ++number) {
    setPoints.push_back(std::max(0.0, 300 - number * 17.6));
    const double late = setPoints[static_cast<std::size_t>(std::max(0, number - 4))];
    const double noise = 0.001 * (number % 2);
    EXPECT_EQ(cycle(measured(late, noise), late * 0.05236, setPoints.back()), StopCause::None)
        << number;
  }
}

/// @brief If the order sets a voltage, the velocity is not compared with a set-point: 210 rpm at 12
/// V does not cause a stop.
/// @verifies FR-276
TEST_F(SupervisedWheel, FR276_OrdersOfVoltageHaveNoSetPointOfVelocity) {
  const WheelSetPoint order{.quantity = WheelQuantity::Tension, .value = 12000};
  for (int number = 0; number < 10; ++number) {
    EXPECT_EQ(wheel.examine(measured(210, 0.67 + 0.001 * (number % 2)), Tension(12000), &order),
              StopCause::None);
  }
}

/// @brief At 10 V and 2 A, the voltage at the winding is 3 V. The voltage of the wheel may differ
/// from the voltage of the motor model by the sum of 0.7 V, 20 % of 10 V, 25 % of 3 V and 10 % of
/// the induced voltage. A greater difference in two successive cycles causes a stop.
/// @verifies FR-277
TEST_F(SupervisedWheel, FR277_ADifferenceToTheModelIsACause) {
  // The induced voltage e is the solution of 10 V - 3 V - e = kPermitted + 0.1 e.
  constexpr double kPermitted = 0.7 + 0.2 * 10 + 0.25 * 3;  // [V] without the share of e
  const double permitted = (10 - 3 - kPermitted) / 1.1 / 0.05236;
  EXPECT_EQ(cycle(measured(permitted, 2), 10, 300), StopCause::None);
  EXPECT_EQ(firstCause(20, measured(permitted + 0.3, 2), 10, 300), 0);
  EXPECT_EQ(firstCause(20, measured(permitted - 0.3, 2), 10, 300), 2);
  EXPECT_EQ(cause, StopCause::Tracking);
}

/// @brief These tolerances do not cause a stop: a supply from 21 V to 29 V, a resistance of 75 % to
/// 125 % of its nominal value, and a motor constant of 90 % to 110 % of its nominal value. This is
/// tested in both directions. In each test, the wheel turns in the direction of its voltage, at up
/// to 330 rpm.
/// @verifies FR-277
TEST_F(SupervisedWheel, FR277_TolerancesOfTheRobotAreNoCause) {
  int points = 0;
  for (const double supply : {21.0, 24.0, 29.0}) {
    for (const double constant : {0.9, 1.0, 1.1}) {
      for (const double resistance : {0.75, 1.0, 1.25}) {
        for (double volts = -24; volts <= 24; volts += 2) {
          for (double amperes = -14; amperes <= 14; amperes += 2) {
            const double real = volts * supply / 24;
            const double rpm = (real - 1.5 * resistance * amperes) / (0.05236 * constant);
            if (std::abs(rpm) > 330 || rpm * volts < 0) {
              continue;
            }
            wheel.reset();
            const WheelSetPoint order{.quantity = WheelQuantity::Tension,
                                      .value = static_cast<std::int16_t>(volts * 1000)};
            for (int number = 0; number < 5; ++number) {
              ASSERT_EQ(wheel.examine(measured(rpm, amperes),
                                      Tension(static_cast<std::int32_t>(volts * 1000)), &order),
                        StopCause::None)
                  << supply << " V, " << volts << " V, " << amperes << " A, " << rpm << " rpm";
            }
            ++points;
          }
        }
      }
    }
  }
  EXPECT_GT(points, 1000);
}

/// @brief A difference that is equal to the permitted difference does not cause a stop. A
/// difference that is 1 mV greater causes a stop. At 60 rpm, 2 A and 9.881 V, the permitted
/// difference is 3.740 V. It is the sum of 0.7 V, 20 % of the voltage of the wheel, 25 % of the 3 V
/// at the winding and 10 % of the induced voltage of 3.141 V.
/// @verifies FR-277
TEST_F(SupervisedWheel, FR277_TheLimitOfTheDifferenceIsPermitted) {
  static_assert(700 + 9881 * 20 / 100 + 3000 * 25 / 100 + 3141 * 10 / 100 == 3740, "in mV");
  EXPECT_EQ(difference(9881, 60, 2000), 3740);
  EXPECT_EQ(difference(9882, 60, 2000), 3741);
  const WheelSetPoint followed = velocity(60);
  for (int number = 0; number < 4; ++number) {
    EXPECT_EQ(wheel.examine(measured(60, 2), Tension(9881), &followed), StopCause::None);
  }
  EXPECT_EQ(wheel.examine(measured(60, 2), Tension(9882), &followed), StopCause::None);
  EXPECT_EQ(wheel.examine(measured(60, 2), Tension(9882), &followed), StopCause::None);
  EXPECT_EQ(wheel.examine(measured(60, 2), Tension(9882), &followed), StopCause::Tracking);
}

/// @brief The permitted difference is the same for a wheel that drives backwards.
/// @verifies FR-277
TEST_F(SupervisedWheel, FR277_TheLimitOfTheDifferenceIsTheSameBackwards) {
  const WheelSetPoint followed = velocity(-60);
  for (int number = 0; number < 4; ++number) {
    EXPECT_EQ(wheel.examine(measured(-60, -2), Tension(-9881), &followed), StopCause::None);
  }
  EXPECT_EQ(wheel.examine(measured(-60, -2), Tension(-9882), &followed), StopCause::None);
  EXPECT_EQ(wheel.examine(measured(-60, -2), Tension(-9882), &followed), StopCause::None);
  EXPECT_EQ(wheel.examine(measured(-60, -2), Tension(-9882), &followed), StopCause::Tracking);
}

/// @brief While a wheel is halted and still has voltage, its measurements are checked too. Three
/// faults each cause a stop: a motor that turns its wheel in the wrong direction, a voltage that
/// does not match, and swapped leads.
/// @verifies FR-275
/// @verifies FR-277
/// @verifies FR-307
TEST_F(SupervisedWheel, FR275_FR277_FR307_AHaltedWheelIsChecked) {
  EXPECT_EQ(halted(measured(0, 2), 3.0), StopCause::None);
  EXPECT_EQ(halted(measured(-25, 1.13), 3.0), StopCause::None);
  EXPECT_EQ(halted(measured(-25, 1.13), 3.0), StopCause::WrongDirection);
  wheel.reset();
  EXPECT_EQ(halted(measured(60, 2), 9.9), StopCause::None);
  EXPECT_EQ(halted(measured(60, 2), 9.9), StopCause::None);
  EXPECT_EQ(halted(measured(60, 2), 9.9), StopCause::Tracking);
  wheel.reset();
  const auto turning = [&](int number, double amperes) {
    WheelMeasurements values = measured(20, amperes + 0.001 * (number % 2));
    values.position = HallCount(2 * number);
    return halted(values, 3.0);
  };
  for (int number = 0; number < 50; ++number) {
    EXPECT_EQ(turning(number, (3.0 - 20 * 0.05236) / 1.5), StopCause::None);
  }
  for (int number = 50; number < 60 && cause == StopCause::None; ++number) {
    cause = turning(number, (3.0 + 20 * 0.05236) / 1.5);
  }
  EXPECT_EQ(cause, StopCause::Tracking);
}

/// @brief The voltage of the bring-up is 1.0 V. A wheel at rest has a current of -0.25 A. At 1.0 V,
/// this current does not cause a stop, although the voltage of the wheel differs from the voltage
/// of the motor model by 1.375 V. At 1.1 V, the permitted difference is smaller, and the same
/// current causes a stop.
/// @verifies FR-277
TEST_F(SupervisedWheel, FR277_UpToOneVoltMoreIsPermitted) {
  EXPECT_EQ(difference(1000, 0, -250), 1375);
  EXPECT_EQ(firstCause(20, measured(0, -0.25), 1.0, 0), 0);
  wheel.reset();
  EXPECT_EQ(firstCause(20, measured(0, -0.25), 1.1, 0), 3);
  EXPECT_EQ(cause, StopCause::Tracking);
}

/// @brief The leads of a wheel are swapped, and the other wheels pull this wheel forwards. This
/// causes a stop in the second cycle.
/// @verifies FR-277
TEST_F(SupervisedWheel, FR277_SwappedLeadsAreACause) {
  for (const double rpm : {50, 80, 150, 300}) {
    wheel.reset();
    const double volts = rpm * 0.05236 + 1.5;
    const double amperes = std::min((volts + rpm * 0.05236) / 1.5, 20.0);
    EXPECT_EQ(cycle(measured(rpm, 1), volts, rpm), StopCause::None);
    EXPECT_EQ(firstCause(2, measured(rpm, amperes), volts, rpm), 2) << rpm;
    EXPECT_EQ(cause, StopCause::Tracking);
  }
}

/// @brief A wheel has a voltage of more than 1.0 V. If its current stays the same in seven
/// successive cycles, the seventh cycle causes a stop, even if the voltage is constant. A current
/// that varies by 1 mA does not cause a stop. At 1.0 V, a constant current does not cause a stop.
/// @verifies FR-278
TEST_F(SupervisedWheel, FR278_ACurrentThatStaysTheSameIsACause) {
  const auto stuckFor = [&](int cycles, double rpm, double volts, double noise) {
    wheel.reset();
    for (int number = 1; number <= cycles; ++number) {
      cause = cycle(measured(rpm, 0.1 + noise * (number % 2)), volts, rpm);
      if (cause != StopCause::None) {
        return number;
      }
    }
    return 0;
  };
  EXPECT_EQ(stuckFor(7, 150, 8, 0), 0);
  EXPECT_EQ(stuckFor(9, 150, 8, 0), 8);  // there is no voltage before the first cycle
  EXPECT_EQ(cause, StopCause::MissingMeasurement);
  EXPECT_EQ(stuckFor(50, 150, 8, 0.001), 0);
  EXPECT_GT(stuckFor(50, 18, 1.1, 0), 0);
  EXPECT_EQ(stuckFor(50, 18, 1.0, 0), 0);
  EXPECT_EQ(stuckFor(9, -150, -8, 0), 8);
  EXPECT_GT(stuckFor(50, -18, -1.1, 0), 0);
  EXPECT_EQ(stuckFor(50, -18, -1.0, 0), 0);
}

/// @brief A wheel at rest without voltage has no current. A current of more than 1.0 A in two
/// successive cycles causes a stop. A current of 1.0 A does not cause a stop. While the wheel
/// turns, a current of 1.1 A does not cause a stop either.
/// @verifies FR-277
TEST_F(SupervisedWheel, FR277_ACurrentAtRestIsACause) {
  EXPECT_EQ(halted(measured(0, 1.0)), StopCause::None);
  for (int number = 0; number < 20; ++number) {
    EXPECT_EQ(halted(measured(0, 1.0)), StopCause::None);
    EXPECT_EQ(halted(measured(0.1, -1.1)), StopCause::None);
  }
  EXPECT_EQ(halted(measured(0, -1.001)), StopCause::None);
  EXPECT_EQ(halted(measured(0, -1.001)), StopCause::Tracking);
}

/// @brief A measurement may be missing in one cycle. If it is also missing in the next cycle, a
/// protective stop follows. A halted wheel without measurements does not cause a stop.
/// @verifies FR-278
TEST_F(SupervisedWheel, FR278_AMissingMeasurementIsACause) {
  WheelMeasurements missing;
  missing.current = Current(1000);
  EXPECT_EQ(cycle(measured(150, 1), 9.354, 150), StopCause::None);
  EXPECT_EQ(firstCause(1, missing, 9.354, 150), 0);
  EXPECT_EQ(firstCause(2, measured(150, 1), 9.354, 150), 0);
  EXPECT_EQ(firstCause(2, missing, 9.354, 150), 2);
  EXPECT_EQ(cause, StopCause::MissingMeasurement);
  wheel.reset();
  for (int number = 0; number < 10; ++number) {
    EXPECT_EQ(halted(WheelMeasurements{}), StopCause::None);
  }
}

/// @brief A missing current causes a stop in the second cycle, as a missing velocity does.
/// @verifies FR-278
TEST_F(SupervisedWheel, FR278_AMissingCurrentIsACause) {
  WheelMeasurements missing;
  missing.velocity = Velocity(1500);
  EXPECT_EQ(cycle(measured(150, 1), 9.354, 150), StopCause::None);
  EXPECT_EQ(firstCause(2, missing, 9.354, 150), 2);
  EXPECT_EQ(cause, StopCause::MissingMeasurement);
}

/// @brief A wheel with implausible Hall edges in successive cycles.
class RejectedEdges : public SupervisedWheel {
 protected:
  // Runs cycles with the same number of implausible edges in each cycle. Returns the cause of the
  // last cycle.
  StopCause rejected(int cycles, std::uint32_t edges, double rpm = 150, double volts = 9.354) {
    StopCause found = StopCause::None;
    for (int number = 0; number < cycles; ++number) {
      total_ += edges;
      milliamperes_ = milliamperes_ == 0 ? 1 : 0;  // the current varies, as in a real sensor
      WheelMeasurements values = measured(rpm, 1 + milliamperes_ / 1000.0);
      values.rejectedEdges = total_;
      found = cycle(values, volts, rpm);
    }
    return found;
  }

  std::uint32_t total_ = 0;

 private:
  int milliamperes_ = 0;
};

/// @brief While the wheel has voltage, a count of nine implausible edges causes a stop. In each
/// cycle, at most five edges are added to the count, and half an edge is subtracted. Edges before
/// the first cycle are not counted.
/// @verifies FR-279
TEST_F(RejectedEdges, FR279_NineAreACause) {
  EXPECT_EQ(rejected(1, 200), StopCause::None);
  EXPECT_EQ(rejected(1, 5), StopCause::None);
  EXPECT_EQ(rejected(1, 0), StopCause::None);
  EXPECT_EQ(rejected(1, 200), StopCause::None);
  EXPECT_EQ(rejected(1, 5), StopCause::HallSignals);
}

/// @brief Half an edge is subtracted in each cycle, also in a cycle with edges. Therefore nine
/// edges in two cycles cause no stop, but ten edges in two cycles do.
/// @verifies FR-279
TEST_F(RejectedEdges, FR279_NineEdgesInTwoCyclesAreNoCause) {
  EXPECT_EQ(rejected(1, 0), StopCause::None);
  EXPECT_EQ(rejected(1, 5), StopCause::None);
  EXPECT_EQ(rejected(1, 4), StopCause::None);
  EXPECT_EQ(rejected(30, 0), StopCause::None);
  EXPECT_EQ(rejected(1, 5), StopCause::None);
  EXPECT_EQ(rejected(1, 5), StopCause::HallSignals);
}

/// @brief Implausible edges are still counted when their number since the start exceeds 65535, and
/// when this number overflows.
/// @verifies FR-279
TEST_F(RejectedEdges, FR279_TheNumberSinceTheStartDoesNotMatter) {
  for (const std::uint32_t before : {65'533U, 65'535U, 70'000U, 0xFFFF'FFFDU}) {
    wheel.reset();
    total_ = before;
    EXPECT_EQ(rejected(1, 0), StopCause::None);
    EXPECT_EQ(rejected(1, 5), StopCause::None);
    EXPECT_EQ(rejected(1, 5), StopCause::HallSignals) << before;
  }
}

/// @brief Implausible edges are also counted while the wheel drives backwards.
/// @verifies FR-279
TEST_F(RejectedEdges, FR279_EdgesCountBackwards) {
  EXPECT_EQ(rejected(1, 0, -150, -9.354), StopCause::None);
  EXPECT_EQ(rejected(2, 5, -150, -9.354), StopCause::HallSignals);
  wheel.reset();
  EXPECT_EQ(rejected(6, 2, -150, -9.354), StopCause::None);
  EXPECT_EQ(rejected(1, 2, -150, -9.354), StopCause::HallSignals);
}

/// @brief In a cycle without a measured velocity, the velocity of the previous cycle decides
/// whether the edges are counted.
/// @verifies FR-279
TEST_F(RejectedEdges, FR279_EdgesCountWithoutAVelocity) {
  EXPECT_EQ(rejected(6, 2), StopCause::None);
  WheelMeasurements values;
  values.current = Current(1005);
  values.rejectedEdges = total_ + 2;
  EXPECT_EQ(cycle(values, 9.354, 150), StopCause::HallSignals);
}

/// @brief A lost edge causes two implausible edges. One lost edge in each cycle causes a stop in
/// the seventh cycle. One lost edge in every fifth cycle does not cause a stop.
/// @verifies FR-279
TEST_F(RejectedEdges, FR279_SingleLostEdgesAddUp) {
  EXPECT_EQ(rejected(6, 2), StopCause::None);
  EXPECT_EQ(rejected(1, 2), StopCause::HallSignals);
  wheel.reset();
  for (int half = 0; half < 100; ++half) {
    EXPECT_EQ(rejected(1, 2), StopCause::None);
    EXPECT_EQ(rejected(4, 0), StopCause::None);
  }
}

/// @brief A wheel that rests exactly at an edge may cause implausible edges. Below 10 rpm, fewer
/// than five implausible edges in a cycle are not counted.
/// @verifies FR-279
TEST_F(RejectedEdges, FR279_AWheelAtRestMayGiveSome) {
  EXPECT_EQ(rejected(100, 4, 9, 2), StopCause::None);
  EXPECT_EQ(rejected(1, 5, 9, 2), StopCause::None);
  EXPECT_EQ(rejected(1, 5, 9, 2), StopCause::HallSignals);
}

/// @brief In a cycle whose edges are not counted, half an edge is still subtracted from the count.
/// At 10.0 rpm or more, fewer than five edges in a cycle are also counted.
/// @verifies FR-279
TEST_F(RejectedEdges, FR279_ACycleWithoutEdgesSubtractsHalfAnEdge) {
  EXPECT_EQ(rejected(1, 200, 9, 2), StopCause::None);
  EXPECT_EQ(rejected(1, 5, 9, 2), StopCause::None);  // 4.5 edges
  EXPECT_EQ(rejected(1, 0, 9, 2), StopCause::None);  // 4 edges
  EXPECT_EQ(rejected(1, 5, 9, 2), StopCause::None);  // 8.5 edges
  EXPECT_EQ(rejected(1, 1, 10, 2), StopCause::HallSignals);
}

/// @brief Without voltage, implausible edges do not cause a stop.
/// @verifies FR-279
TEST_F(RejectedEdges, FR279_WithoutVoltageNoneIsACause) {
  WheelMeasurements values = measured(0, 0);
  for (int number = 0; number < 5; ++number) {
    values.rejectedEdges += 50;
    EXPECT_EQ(halted(values), StopCause::None);
  }
}

/// A wheel with faults. A fault is present in every cycle or in every second cycle.
class FaultyWheel : public SupervisedWheel {
 protected:
  enum class Fault { Opposing, TooFast, Deviating, Missing, Edges, EqualCurrent, Swapped };

  static constexpr std::array kFaults{Fault::Opposing, Fault::TooFast, Fault::Deviating,
                                      Fault::Missing,  Fault::Edges,   Fault::EqualCurrent,
                                      Fault::Swapped};

  /// Runs a cycle of a wheel. The faults TooFast, EqualCurrent and Swapped are present in each
  /// cycle. The other faults are present if the number of the cycle is a multiple of `multiple`.
  static StopCause faulty(WheelSupervision& supervised, Fault fault, int number, int multiple) {
    const bool present = number % multiple == 0;
    const double noise = fault == Fault::EqualCurrent ? 0 : 0.001 * (number % 2);
    WheelMeasurements values = measured(150, 1 + noise);
    std::int32_t millivolts = 9354;
    double setPoint = 150;
    switch (fault) {
      case Fault::Opposing:
        values = present ? measured(-30, 0.95 + noise) : measured(0, 2 + noise);
        millivolts = 3000;
        setPoint = 30;
        break;
      case Fault::TooFast:
        setPoint = number < 12 ? 20 : 10;
        break;
      case Fault::Deviating:
        values = measured(150, (present ? 12 : 1) + noise);
        break;
      case Fault::Missing:
        if (present) {
          values.velocity.reset();
        }
        break;
      case Fault::Edges:
        values.rejectedEdges = static_cast<std::uint32_t>(3 * (number / multiple));
        break;
      case Fault::EqualCurrent:
        break;
      case Fault::Swapped:
        values = measured(40, (3.2 + 40 * 0.05236) / 1.5 + noise);
        values.position = HallCount(4 * number);
        millivolts = 3200;
        setPoint = 40;
        break;
    }
    const WheelSetPoint followed = velocity(setPoint);
    return supervised.examine(values, Tension(millivolts), &followed);
  }
};

/// @brief After a call of reset(), the supervision behaves as at the start. A fault before this
/// call, in up to 15 cycles, has no effect on the cycle in which a later fault is detected.
/// @verifies FR-275
/// @verifies FR-276
/// @verifies FR-277
/// @verifies FR-278
/// @verifies FR-279
TEST_F(FaultyWheel, FR275_FR279_AResetForgetsEarlierFaults) {
  for (const Fault earlier : kFaults) {
    for (const Fault later : kFaults) {
      for (int cycles = 1; cycles < 16; ++cycles) {
        for (const int multiple : {1, 2}) {
          WheelSupervision used;
          for (int number = 0; number < cycles; ++number) {
            faulty(used, earlier, number, 1);
          }
          used.reset();
          WheelSupervision unused;
          for (int number = 0; number < 25; ++number) {
            ASSERT_EQ(faulty(used, later, number, multiple),
                      faulty(unused, later, number, multiple))
                << static_cast<int>(earlier) << ' ' << static_cast<int>(later) << ' ' << cycles
                << ' ' << number;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace wr::test
