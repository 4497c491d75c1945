#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "wheel_control/ControlledWheel.hpp"
#include "wheel_control/CoupledWheels.hpp"
#include "wheel_control/WheelPlant.hpp"

namespace wr::test {
namespace {

/// The controller in a closed loop with a model of the motor and the robot.
class ClosedLoopTest : public testing::Test, protected ControlledWheel {
 protected:
  void run(const WheelSetPoint& setPoint, int cycles) {
    for (int cycle = 0; cycle < cycles; ++cycle) {
      plant.cycle(*this);
      greatest = std::max(greatest, plant.present().count());
      least = std::min(least, plant.present().count());
      const bool before = orientation.isOn();
      const Velocity measured = plant.velocity();
      control(setPoint, measured, plant.current());
      if (orientation.isOn() != before) {
        ++flips;
        velocityAtFlip = measured;
      }
    }
  }

  void restart() {
    greatest = plant.present().count();
    least = plant.present().count();
  }

  WheelPlant plant;
  int greatest = 0;
  int least = 0;
  int flips = 0;
  Velocity velocityAtFlip{};
};

// Torques at the shaft, for a quarter of 175 kg behind a gear of 10 to 1.
constexpr double kRolling = 0.55;  // [N m]
constexpr double kSlope = 1.17;    // [N m] torque of a slope of 10 %

/// @brief A wheel accelerates from 0 rpm to 150 rpm with less than 10 % overshoot. Its velocity
/// stays within 2 % of 150 rpm, beginning 2 s after the order. This is true for three values of
/// the inertia.
/// @verifies FR-82
TEST_F(ClosedLoopTest, FR82_StepReachesTheVelocity) {
  for (const double inertia : {0.037, 0.028, 0.048}) {
    ControlledWheel one;
    WheelPlant other;
    other.inertia = inertia;
    other.friction = kRolling;
    int most = 0;
    for (int cycle = 0; cycle < 50; ++cycle) {
      one.control(velocityOf(1500), other.velocity(), other.current());
      other.cycle(one);
      most = std::max(most, other.present().count());
      if (cycle >= 19) {
        EXPECT_NEAR(other.present().count(), 1500, 30) << cycle;
      }
    }
    EXPECT_LT(most, 1650);
  }
}

/// @brief On flat ground, the velocity of a wheel stays within 1 % of 150 rpm, beginning 3 s after
/// the order.
/// @verifies FR-83
TEST_F(ClosedLoopTest, FR83_VelocityIsKeptOnTheFlat) {
  plant.load = kRolling;
  run(velocityOf(1500), 30);
  restart();
  run(velocityOf(1500), 10);
  EXPECT_GE(least, 1485);
  EXPECT_LE(greatest, 1515);
}

/// @brief On an uphill slope, the velocity of a wheel stays within 2 % of 150 rpm, beginning 3 s
/// after the wheel has reached the slope.
/// @verifies FR-300
TEST_F(ClosedLoopTest, FR300_VelocityIsKeptUphill) {
  plant.load = kRolling;
  run(velocityOf(1500), 30);
  plant.load = kRolling + kSlope;
  run(velocityOf(1500), 30);
  restart();
  run(velocityOf(1500), 10);
  EXPECT_GE(least, 1470);
  EXPECT_LE(greatest, 1530);
}

/// @brief The robot drives from flat ground onto a downhill slope of 10 %. The rear axle reaches
/// the slope 37 cycles after the front axle. In these cycles and after them, the velocity of the
/// wheel is at most 165 rpm. Then the velocity settles.
/// @verifies FR-84
TEST_F(ClosedLoopTest, FR84_NotMuchFasterDownhill) {
  plant.load = kRolling;
  run(velocityOf(1500), 50);
  constexpr int kCycles = 37;
  restart();
  for (int cycle = 0; cycle < kCycles; ++cycle) {
    plant.load -= kSlope / kCycles;
    run(velocityOf(1500), 1);
  }
  run(velocityOf(1500), 50);
  EXPECT_GT(greatest, 1500);
  EXPECT_LT(greatest, 1650);
  EXPECT_NEAR(plant.present().count(), 1500, 15);
}

/// @brief While the wheel accelerates, the error of the current is at most 5 % of the order,
/// beginning 1 s after the order.
/// @verifies FR-85
TEST_F(ClosedLoopTest, FR85_CurrentIsReachedInOneSecond) {
  plant.load = kRolling;
  run(currentOf(3000), 11);
  for (int cycle = 0; cycle < 5; ++cycle) {
    run(currentOf(3000), 1);
    ASSERT_LT(controller.applied(), Tension(24000));
    EXPECT_NEAR(plant.current().count(), 3000, 150) << cycle;
  }
}

/// @brief With an order of 3 A, a wheel without friction becomes faster than 150 rpm. The next
/// order is -0.5 A. 1 s after this order, the error of the current is at most 0.1 A.
/// @verifies FR-85
TEST_F(ClosedLoopTest, FR85_BrakingCurrentIsReached) {
  run(currentOf(3000), 14);
  ASSERT_GT(plant.velocity(), Velocity(1500));
  run(currentOf(-500), 11);
  EXPECT_NEAR(plant.current().count(), -500, 100);
}

/// @brief A wheel with friction turns at 300 rpm. 1 s after an order of -0.5 A or -1 A, the error
/// of the current is at most 0.2 A.
/// @verifies FR-85
TEST_F(ClosedLoopTest, FR85_CurrentOfADeceleratingWheel) {
  for (const std::int16_t order : {std::int16_t{-500}, std::int16_t{-1000}}) {
    ControlledWheel one;
    WheelPlant other;
    other.friction = kRolling;
    for (int cycle = 0; cycle < 60; ++cycle) {
      one.control(velocityOf(3000), other.velocity(), other.current());
      other.cycle(one);
    }
    for (int cycle = 0; cycle < 11; ++cycle) {
      one.control(currentOf(order), other.velocity(), other.current());
      other.cycle(one);
    }
    ASSERT_GT(one.controller.applied(), Tension(0));
    EXPECT_NEAR(other.current().count(), order, 200);
  }
}

/// @brief Beginning 1 s after the order, the error of the current is at most the greater of two
/// values: 5 % of the order, and 0.1 A. This is tested over the whole range of currents, in both
/// directions, for the extreme values of supply, winding and motor constant. Friction consumes 97 %
/// of the torque. The wheel therefore stays slow, and the supply is sufficient.
/// @verifies FR-85
TEST(CurrentLoop, FR85_CurrentsOverTheWholeRange) {
  for (const double supply : {21.0, 24.0, 29.0}) {
    for (const double resistance : {1.275, 1.725}) {
      for (const double constant : {0.425, 0.575}) {
        for (const int target : {100, 500, 1000, 2000, 3000, 5000, 8000, 10000}) {
          for (const int direction : {1, -1}) {
            ControlledWheel wheel;
            WheelPlant plant;
            plant.supply = supply;
            plant.resistance = resistance;
            plant.constant = constant;
            plant.friction = 0.97 * constant * target / 1000;
            const auto order = static_cast<std::int16_t>(direction * target);
            for (int cycle = 0; cycle < 20; ++cycle) {
              wheel.control(currentOf(order), plant.velocity(), plant.current());
              plant.cycle(wheel);
              if (cycle >= 10) {
                EXPECT_NEAR(plant.current().count(), order, std::max(target / 20, 100))
                    << cycle << ": " << supply << " V, " << resistance << " ohm, " << constant
                    << " V s/rad";
              }
            }
          }
        }
      }
    }
  }
}

/// @brief A step to 300 rpm is delayed, because the rise of the voltage is limited. The overshoot
/// is less than 10 %.
/// @verifies FR-301
TEST_F(ClosedLoopTest, FR301_DelayedStepIsHardlyOvershot) {
  run(velocityOf(3000), 1);
  ASSERT_EQ(controller.applied(), Tension(12000));
  run(velocityOf(3000), 39);
  EXPECT_LT(greatest, 3300);
  EXPECT_NEAR(plant.present().count(), 3000, 30);
}

/// @brief The supply is not sufficient for the first current order. The second current order is
/// lower. Beginning 1 s after this order, the error of the current is at most 5 %. The overshoot is
/// less than 10 %.
/// @verifies FR-301
TEST_F(ClosedLoopTest, FR301_NoWindUp) {
  plant.load = 1.455;  // this load needs 3 A
  run(currentOf(10000), 60);
  ASSERT_EQ(controller.applied(), Tension(24000));
  ASSERT_NEAR(plant.current().count(), 3000, 30);
  run(currentOf(2000), 1);
  for (int cycle = 1; cycle <= 20; ++cycle) {
    run(currentOf(2000), 1);
    EXPECT_GT(plant.current(), Current(1800)) << cycle;
    if (cycle >= 10) {
      EXPECT_NEAR(plant.current().count(), 2000, 100) << cycle;
    }
  }
}

/// @brief With each of three loads, the supply voltage is too low for the first ordered velocity.
/// The velocity after the second order has an overshoot of less than the greater of 10 % and 3 rpm.
/// @verifies FR-301
TEST_F(ClosedLoopTest, FR301_NoWindUpOfTheVelocity) {
  for (const double load : {3.3, 3.6, 3.9}) {
    for (const std::int16_t next :
         {std::int16_t{1500}, std::int16_t{500}, std::int16_t{200}, std::int16_t{50}}) {
      plant.load = load;  // these loads need 6.8, 7.4 and 8 A
      run(velocityOf(3000), 60);
      ASSERT_EQ(controller.applied(), Tension(24000)) << load;
      ASSERT_LT(plant.present(), Velocity(2900)) << load;
      restart();
      run(velocityOf(next), 30);
      EXPECT_GT(least, next - std::max(next * 0.1, 30.0)) << load;
      EXPECT_NEAR(plant.present().count(), next, 30) << load;
    }
  }
}

/// @brief A wheel reverses from 150 rpm forwards to 150 rpm backwards. It is slower than 40 rpm
/// when its orientation changes, and exceeds its new set-point by less than 10 %.
/// @verifies FR-87
/// @verifies FR-301
TEST_F(ClosedLoopTest, FR87_FR301_ReverseSlowsDownFirst) {
  run(velocityOf(1500), 30);
  run(velocityOf(-1500), 60);
  EXPECT_EQ(flips, 1);
  EXPECT_LT(std::abs(velocityAtFlip.count()), 400);
  EXPECT_GT(least, -1650);
  EXPECT_NEAR(plant.present().count(), -1500, 30);
}

/// Results of a step of the velocity order.
struct Step {
  double overshoot = 0;  // [0.1 rpm] velocity beyond the target
  double settled =
      0;  // [s] time after which the velocity remains within the greater of 5 % and 2 rpm
  double steady = 0;  // [0.1 rpm] error of the mean over the fifth second
};

/// Orders a velocity for 10 s, and checks the velocity at the end of each cycle.
Step stepTo(ControlledWheel& wheel, WheelPlant& plant, int target) {
  Step step;
  double sum = 0;
  const int direction = target < 0 ? -1 : 1;
  for (int cycle = 0; cycle < 100; ++cycle) {
    wheel.control(velocityOf(static_cast<std::int16_t>(target)), plant.velocity(), plant.current());
    plant.cycle(wheel);
    const double error = plant.present().count() - target;
    step.overshoot = std::max(step.overshoot, error * direction);
    if (std::abs(error) > std::max(std::abs(target) * 0.05, 20.0)) {
      step.settled = (cycle + 1) * 0.1;
    }
    sum += cycle >= 40 && cycle < 50 ? plant.velocity().count() - target : 0;
  }
  step.steady = std::abs(sum / 10);
  return step;
}

/// One motor, battery and load from the range for which the velocity loop is designed.
struct Variant {
  double supply;
  double inertia;
  double resistance;
  double constant;
  double friction;
};

/// Returns all combinations of the extreme values of supply, inertia, winding, motor constant and
/// rolling resistance. For supply and inertia, the nominal value is also included.
std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const double supply : {21.0, 24.0, 29.0}) {
    for (const double inertia : {0.0185, 0.037, 0.074}) {
      for (const double resistance : {1.275, 1.725}) {
        for (const double constant : {0.425, 0.575}) {
          for (const double friction : {0.0, kRolling}) {
            all.push_back({supply, inertia, resistance, constant, friction});
          }
        }
      }
    }
  }
  return all;
}

WheelPlant plantOf(const Variant& variant) {
  WheelPlant plant;
  plant.supply = variant.supply;
  plant.inertia = variant.inertia;
  plant.resistance = variant.resistance;
  plant.constant = variant.constant;
  plant.friction = variant.friction;
  return plant;
}

/// @brief After a step from rest, a wheel settles in 3 s with less than 30 % overshoot. The error
/// of its mean velocity over the fifth second is at most the greater of 1 % and 0.5 rpm. This is
/// tested over the whole range of velocities, in both directions, with the extreme values of
/// supply, inertia, winding, motor constant and rolling resistance.
/// @verifies FR-223
TEST(VelocityLoop, FR223_StepsOverTheWholeRange) {
  for (const Variant& variant : variants()) {
    for (const int target : {50, 200, 500, 1500, 3000, -50, -200, -500, -1500, -3000}) {
      ControlledWheel wheel;
      WheelPlant plant = plantOf(variant);
      const Step step = stepTo(wheel, plant, target);
      const auto name = ::testing::Message()
                        << target << ": " << variant.supply << " V, " << variant.inertia
                        << " kg m2, " << variant.resistance << " ohm, " << variant.constant
                        << " V s/rad, " << variant.friction << " N m";
      EXPECT_LT(step.overshoot, std::abs(target) * 0.3) << name;
      EXPECT_LE(step.settled, 3.0) << name;
      EXPECT_LE(step.steady, std::max(std::abs(target) * 0.01, 5.0)) << name;
    }
  }
}

/// @brief With simulated Hall sensors, a step from rest to 50 rpm or more settles in 3 s with less
/// than 30 % overshoot. A step to 5 rpm or 20 rpm settles in 5 s with less than 9 rpm overshoot.
/// @verifies FR-223
TEST(VelocityLoop, FR223_StepsWithHallSensors) {
  for (const Variant& variant : variants()) {
    for (const int target : {50, -200, 500, -3000}) {
      SimulatedWheel wheel;
      wheel.supply = variant.supply;
      wheel.resistance = variant.resistance;
      wheel.constant = variant.constant;
      double overshoot = 0;  // [0.1 rpm]
      double settled = 0;    // [s]
      for (int cycle = 1; cycle <= 60; ++cycle) {
        wheel.follow(velocityOf(static_cast<std::int16_t>(target)));
        for (int tick = 0; tick < 100; ++tick) {
          const double driving = wheel.torque();
          const double rest = driving + wheel.speed * variant.inertia / 0.001;
          const double opposing = std::clamp(rest, -variant.friction, variant.friction);
          wheel.speed += (driving - opposing) / variant.inertia * 0.001;
          wheel.turn(0.001);
          wheel.tick();
        }
        const double error = wheel.velocity() - target;
        overshoot = std::max(overshoot, target < 0 ? -error : error);
        if (std::abs(error) > std::max(std::abs(target) * 0.05, 20.0)) {
          settled = cycle * 0.1;
        }
      }
      const bool fast = std::abs(target) >= 500;
      EXPECT_LT(overshoot, fast ? std::abs(target) * 0.3 : 90.0) << target << " " << variant.supply;
      EXPECT_LE(settled, fast ? 3.0 : 5.0) << target << " " << variant.supply;
    }
  }
}

/// @brief A step from one velocity to another settles within 5 s, or within 8 s if the new velocity
/// is 5 rpm. A step that reverses the wheel has the same limits. The limit of 5 s is 2 s longer
/// than for a step from rest, because a wheel must become slow before it reverses.
/// @verifies FR-223
TEST(VelocityLoop, FR223_StepsBetweenVelocitiesAndReversals) {
  for (const Variant& variant : variants()) {
    ControlledWheel wheel;
    WheelPlant plant = plantOf(variant);
    for (const int target :
         {1500, 500, 3000, 200, 1500, -1500, -50, 300, 3000, 50, 3000, -50, -3000, 50, 200, -50}) {
      const Step step = stepTo(wheel, plant, target);
      EXPECT_LE(step.settled, std::abs(target) == 50 ? 8.0 : 5.0)
          << target << " " << variant.supply;
      EXPECT_FALSE(wheel.controller.blind()) << target << " " << variant.supply;
      EXPECT_FALSE(wheel.controller.reversalLate()) << target << " " << variant.supply;
    }
  }
}

/// @brief If a wheel at full speed gets an order of 12 V in the opposite direction, the reversal is
/// never late, even with twice the inertia.
/// @verifies FR-222
TEST(VelocityLoop, FR222_ReversalFromFullSpeedIsInTime) {
  for (const Variant& variant : variants()) {
    ControlledWheel wheel;
    WheelPlant plant = plantOf(variant);
    for (const std::int16_t tension : {std::int16_t{24000}, std::int16_t{-12000}}) {
      for (int cycle = 0; cycle < 60; ++cycle) {
        wheel.control(tensionOf(tension), plant.velocity(), plant.current());
        plant.cycle(wheel);
      }
      EXPECT_FALSE(wheel.controller.reversalLate());
      EXPECT_EQ(wheel.controller.applied(), Tension(tension));
    }
  }
}

/// @brief A wheel turns at 300 rpm when it is halted. 25 cycles later, it is slower than 5 rpm and
/// is short-circuited.
/// @verifies FR-88
TEST_F(ClosedLoopTest, FR88_HaltBringsToRest) {
  run(velocityOf(3000), 40);
  for (int cycle = 0; cycle < 25; ++cycle) {
    controller.halt();
    plant.cycle(*this);
  }
  EXPECT_LT(plant.present(), Velocity(50));
  EXPECT_EQ(output(), Tension(0));
  EXPECT_TRUE(enable.isOn());
}

}  // namespace
}  // namespace wr::test
