#include "safety/LeadsWatch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace wr::test {
namespace {

/// A motor with tolerances. A test sets the velocity and the current of the motor, and can swap its
/// leads.
struct Motor {
  double supply = 24;
  double resistance = 1.5;    // [ohm]
  double constant = 0.05236;  // [V per rpm]
  double offset = 0;          // [A] offset of the current sensor
  double position = 0.5;      // [edges]
  bool swapped = false;
};

class WatchedLeads : public testing::Test {
 protected:
  /// Runs a cycle of the motor. The current is computed from the given velocity and voltage.
  bool cycle(double rpm, double ordered) {
    motor.position += rpm * 60 / 600;
    const double real = ordered * motor.supply / 24;
    const double turning = (motor.swapped ? -1 : 1) * motor.constant * rpm;
    WheelMeasurements measured;
    measured.velocity = Velocity(static_cast<std::int32_t>(std::lround(rpm * 10)));
    const double amperes = (real - turning) / motor.resistance + motor.offset;
    measured.current = Current(static_cast<std::int32_t>(std::lround(amperes * 1000)));
    // The position continues at the other end of its range.
    const auto edges = static_cast<std::int64_t>(std::floor(motor.position));
    measured.position = HallCount(static_cast<std::int32_t>(edges));
    return watch->swapped(measured, Tension(static_cast<std::int32_t>(ordered * 1000)));
  }

  /// Returns the voltage at which the motor has a given velocity and a given current.
  [[nodiscard]] double pulling(double rpm, double amperes) const {
    return (motor.constant * rpm + motor.resistance * amperes) * 24 / motor.supply;
  }

  /// Starts the wheel and drives it for a number of cycles. Returns true if the watch detected
  /// swapped leads.
  bool drive(double rpm, double amperes, int cycles) {
    bool stopped = false;
    const double step = rpm < 0 ? -17.6 : 17.6;
    for (double now = 0; std::abs(now) < std::abs(rpm); now += step) {
      stopped = cycle(now, pulling(now, 3 * amperes)) || stopped;
    }
    for (int number = 0; number < cycles; ++number) {
      stopped = cycle(rpm, pulling(rpm, amperes)) || stopped;
    }
    return stopped;
  }

  /// Swaps the leads, and runs cycles at a constant voltage. Returns the number of cycles until the
  /// watch detects the swapped leads; 0 if it does not detect them within 20 cycles.
  int found(double rpm, double volts) {
    motor.swapped = true;
    for (int number = 1; number <= 20; ++number) {
      if (cycle(rpm, volts)) {
        return number;
      }
    }
    return 0;
  }

  Motor motor;
  std::optional<LeadsWatch> watch{std::in_place};
};

/// @brief At 10 rpm to 300 rpm, in either direction, the watch detects swapped leads in the second
/// cycle.
/// @verifies FR-307
TEST_F(WatchedLeads, FR307_SwappedLeadsAreFoundInTheSecondCycle) {
  for (const double rpm : {10.0, 20.0, 50.0, 150.0, 300.0, -10.0, -20.0, -300.0}) {
    watch->reset();
    motor = {};
    EXPECT_FALSE(drive(rpm, rpm > 0 ? 1 : -1, 40)) << rpm;
    EXPECT_EQ(found(rpm, pulling(rpm, rpm > 0 ? 1 : -1)), 2) << rpm;
  }
}

/// @brief In the second cycle, the position of the wheel continues at the other end of its range.
/// Swapped leads are still detected in this cycle.
/// @verifies FR-177
/// @verifies FR-307
TEST_F(WatchedLeads, FR307_ThePositionContinuesAtTheOtherEnd) {
  for (const double rpm : {150.0, -150.0}) {
    const double amperes = rpm > 0 ? 1 : -1;
    watch->reset();
    motor = {};
    EXPECT_FALSE(drive(rpm, amperes, 40)) << rpm;
    const double driven = motor.position;
    watch->reset();
    // In each cycle the wheel turns by 15 edges. The position overflows in the second cycle after
    // the call of drive().
    motor.position = (rpm > 0 ? 0x1p31 : -0x1p31) - driven - 1.5 * 15 * amperes;
    EXPECT_FALSE(drive(rpm, amperes, 40)) << rpm;
    EXPECT_EQ(found(rpm, pulling(rpm, amperes)), 2) << rpm;
  }
}

/// @brief The watch learns motors whose parameters are at the ends of their tolerances. The supply
/// has 21 V or 29 V, and the current sensor has an error of 0.3 A. Correct leads do not stop the
/// robot, even when load and velocity change at the same time. At 20 rpm, swapped leads are
/// detected within five cycles.
/// @verifies FR-307
TEST_F(WatchedLeads, FR307_EachMotorIsLearned) {
  for (const double supply : {21.0, 29.0}) {
    for (const double resistance : {1.2, 1.875}) {
      for (const double constant : {0.0471, 0.0576}) {
        for (const double offset : {-0.3, 0.3}) {
          motor = {
              .supply = supply, .resistance = resistance, .constant = constant, .offset = offset};
          watch.emplace();
          for (const double rpm : {20.0, 150.0, -60.0, 300.0, -10.0, 50.0}) {
            for (const double amperes : {1.0, 8.0, -5.0}) {
              EXPECT_FALSE(drive(rpm, amperes, 10))
                  << supply << ' ' << resistance << ' ' << constant << ' ' << offset << ' ' << rpm;
            }
          }
          EXPECT_FALSE(drive(20, 1, 40));
          const int cycles = found(20, pulling(20, 1));
          EXPECT_GE(cycles, 2);
          EXPECT_LE(cycles, 5);
        }
      }
    }
  }
}

/// @brief If the measurements match swapped leads in only a single cycle, the robot does not stop,
/// even if the match is perfect.
/// @verifies FR-307
TEST_F(WatchedLeads, FR307_OneCycleIsNotEnough) {
  EXPECT_FALSE(drive(300, 1, 40));
  for (int number = 0; number < 10; ++number) {
    motor.swapped = true;
    EXPECT_FALSE(cycle(300, pulling(300, 1))) << number;
    motor.swapped = false;
    for (int right = 0; right < 2; ++right) {
      EXPECT_FALSE(cycle(300, pulling(300, 1))) << number;
    }
  }
}

/// @brief The watch uses a cycle as evidence only if the cycle has a measured velocity, a measured
/// current, a voltage, and an edge in the direction of the velocity.
/// @verifies FR-307
TEST_F(WatchedLeads, FR307_OnlyCompleteCyclesCount) {
  EXPECT_FALSE(drive(100, 1, 40));
  motor.swapped = true;
  EXPECT_FALSE(cycle(100, pulling(100, 1)));
  WheelMeasurements measured;
  EXPECT_FALSE(watch->swapped(measured, Tension(6000)));
  measured.velocity = Velocity(1000);
  EXPECT_FALSE(watch->swapped(measured, Tension(6000)));
  measured.current = Current(8000);
  EXPECT_FALSE(watch->swapped(measured, std::nullopt));
  measured.position = HallCount(static_cast<std::int32_t>(std::floor(motor.position)));
  for (int number = 0; number < 5; ++number) {
    EXPECT_FALSE(watch->swapped(measured, Tension(6000))) << "without an edge";
  }
  EXPECT_TRUE(cycle(100, pulling(100, 1)));
}

/// @brief At voltages of up to 1 V, swapped leads do not stop the robot. The bring-up uses these
/// voltages.
/// @verifies FR-307
TEST_F(WatchedLeads, FR307_UpToOneVoltNothingCounts) {
  EXPECT_FALSE(drive(10, 1, 40));
  EXPECT_EQ(found(10, 1.0), 0);
  EXPECT_GT(found(10, 1.1), 0);
  watch->reset();
  motor = {};
  EXPECT_FALSE(drive(-10, -1, 40));
  EXPECT_EQ(found(-10, -1.0), 0);
  EXPECT_GT(found(-10, -1.1), 0);
}

/// @brief After a call of reset(), the watch has no evidence of swapped leads.
/// @verifies FR-307
TEST_F(WatchedLeads, FR307_ANewBeginHasNoEvidence) {
  EXPECT_FALSE(drive(100, 1, 40));
  EXPECT_EQ(found(100, pulling(100, 1)), 2);
  EXPECT_TRUE(cycle(100, pulling(100, 1)));
  watch->reset();
  motor.swapped = false;
  EXPECT_FALSE(drive(100, 1, 40));
  EXPECT_EQ(found(100, pulling(100, 1)), 2);
}

/// @brief After a call of reset(), the watch needs as many cycles to detect swapped leads as at the
/// start. This is tested for velocities from 10 rpm to 60 rpm and for currents up to 14 A. Before
/// the call, the watch has learned another motor.
/// @verifies FR-307
TEST_F(WatchedLeads, FR307_AResetForgetsTheMotor) {
  const auto detected = [this](double resistance, double rpm, double amperes) {
    motor = {.resistance = resistance};
    if (resistance > 1.5) {
      cycle(0, pulling(0, amperes));
    }
    return found(rpm, pulling(rpm, amperes));
  };
  for (const double resistance : {1.5, 1.8}) {
    for (double rpm = 10; rpm <= 60; rpm += 2) {
      for (double amperes = 0; amperes <= 14; amperes += 0.5) {
        watch.emplace();
        const int first = detected(resistance, rpm, amperes);
        motor = {.supply = 29, .resistance = 1.2, .constant = 0.0576};
        drive(-200, -8, 40);
        motor.swapped = true;
        cycle(-200, pulling(-200, -1));
        watch->reset();
        EXPECT_EQ(detected(resistance, rpm, amperes), first) << rpm << " rpm, " << amperes << " A";
      }
    }
  }
}

/// @brief If a cycle with correct leads directly follows a cycle with swapped leads, the watch does
/// not learn from the cycle with correct leads.
/// @verifies FR-307
TEST_F(WatchedLeads, FR307_InDoubtNothingIsLearned) {
  motor.resistance = 1.8;
  EXPECT_FALSE(cycle(100, pulling(100, 1)));
  motor.swapped = true;
  EXPECT_FALSE(cycle(100, pulling(100, 1)));
  motor.swapped = false;
  EXPECT_FALSE(cycle(100, pulling(100, 6)));
  EXPECT_EQ(found(10, pulling(10, 0.5)), 7);
}

/// @brief At a low velocity with a great load, a cycle is weak evidence, and the detection needs
/// more cycles. When the watch has learned the parameters of the motor for 4 s, each cycle is
/// stronger evidence than before.
/// @verifies FR-307
TEST_F(WatchedLeads, FR307_WeakEvidenceNeedsMoreCycles) {
  struct Case {
    bool learned;
    double rpm;
    double amperes;
    int cycles;
  };
  for (const auto& [learned, rpm, amperes, cycles] :
       {Case{false, 10, 0.5, 4}, Case{false, 12, 1, 5}, Case{false, 28, 2, 4}, Case{true, 12, 1, 2},
        Case{true, 12, 2.5, 6}, Case{true, 14, 2.5, 6}, Case{true, 20, 4, 4},
        Case{true, 26, 5, 4}}) {
    watch.emplace();
    motor = {};
    if (learned) {
      EXPECT_FALSE(drive(rpm, 1, 40));
    }
    EXPECT_EQ(found(rpm, pulling(rpm, amperes)), cycles) << rpm << " rpm, " << amperes << " A";
  }
}

}  // namespace
}  // namespace wr::test
