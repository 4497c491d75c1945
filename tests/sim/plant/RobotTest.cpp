#include "sim/plant/Robot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "sim/plant/DriveTrain.hpp"
#include "sim/plant/Plant.hpp"
#include "sim/plant/SteeringLinkage.hpp"

namespace wr::test {
namespace {

using plant::DriveTrain;
using plant::Fault;
using plant::HallEdge;
using plant::MotorParameters;
using plant::Plant;
using plant::Robot;
using plant::WheelDrive;

// A robot without noise, with the same inputs for all wheels.
class RobotTest : public testing::Test {
 protected:
  RobotTest() {
    robot.setNoise(false);
    robot.setParameter(plant::Parameter::Battery, 0);
  }

  void drive(const WheelDrive& what) {
    for (std::size_t wheel = 0; wheel < plant::kWheels; ++wheel) {
      robot.setWheel(wheel, what);
    }
  }

  void run(int ms) {
    for (int i = 0; i < ms; ++i) {
      for (const HallEdge& edge : robot.step()) {
        edges.push_back(edge);
      }
    }
  }

  // Returns the number of forward edges minus the number of backward edges of a wheel. The forward
  // sequence of (b, a) is 00, 01, 11, 10.
  [[nodiscard]] int netEdges(std::size_t wheel) const {
    int count = 0;
    std::array<bool, 2> level{};
    for (const HallEdge& edge : edges) {
      if (edge.wheel == wheel) {
        const bool forwards = edge.sensor == 0 ? edge.level != level[1] : edge.level == level[0];
        count += forwards ? 1 : -1;
        level.at(edge.sensor) = edge.level;
      }
    }
    return count;
  }

  // Returns the current that a motor needs at the given speed, when its tyre pulls with the given
  // force. The formula was derived by hand from the equations of a steady state.
  [[nodiscard]] static double currentFor(double force, double rpm) {
    constexpr MotorParameters motor;
    const double torque = force * DriveTrain::kRadius / DriveTrain::kRatio;
    const double gear =
        torque > 0 ? torque / DriveTrain::kEfficiency : torque * DriveTrain::kEfficiency;
    const double speed = rpm * 2 * std::numbers::pi / 60;
    const double friction = std::copysign(motor.friction, rpm) + motor.damping * speed;
    return (gear + friction) / motor.constant;
  }

  // Checks that the robot is in a steady state. The speed must fit Ohm's law, and the current must
  // fit the forces.
  void expectSteady(double volts, double forceOfWheel) const {
    constexpr MotorParameters motor;
    const double rpm = robot.velocityRpm(0);
    const double speed = rpm * 2 * std::numbers::pi / 60;
    const double current = robot.currentAmperes(0);
    EXPECT_NEAR(current * motor.resistance + speed * motor.constant, volts, 0.1);
    EXPECT_NEAR(current, currentFor(forceOfWheel, rpm), 0.05);
  }

  const double kWeight = Plant{}.mass * Robot::kGravity;
  Robot robot{1};
  std::vector<HallEdge> edges;
};

/// @brief At full supply voltage on flat ground, the speed of the wheels follows from Ohm's law,
/// the motor constant, rolling resistance and friction. The speed of the robot is the speed of the
/// wheels minus the slip.
TEST_F(RobotTest, FlatGroundWithTheWholeSupply) {
  drive({.duty = 1.0, .backwards = false, .enabled = true});
  run(6000);
  expectSteady(24.0, 0.04 * kWeight / 4);
  EXPECT_NEAR(robot.velocityRpm(0), 410, 2);
  const double wheels = robot.velocityRpm(0) / 600 * 2 * std::numbers::pi * DriveTrain::kRadius;
  EXPECT_LT(robot.groundSpeed(), wheels);
  EXPECT_GT(robot.groundSpeed(), 0.99 * wheels);
}

/// @brief Uphill, the motors also work against the weight.
TEST_F(RobotTest, TenPercentUphill) {
  robot.setSlope(10);
  drive({.duty = 0.9, .backwards = false, .enabled = true});
  run(6000);
  expectSteady(21.6, (0.1 + 0.04) * kWeight / std::sqrt(1.01) / 4);
  EXPECT_NEAR(robot.velocityRpm(2), 300, 5);
}

/// @brief Downhill, the wheels drive the motors. The current and the power of the motors are
/// negative.
TEST_F(RobotTest, DownhillTheMotorsBrake) {
  robot.setSlope(-10);
  drive({.duty = 0.65, .backwards = false, .enabled = true});
  run(6000);
  expectSteady(0.65 * 24, (-0.1 + 0.04) * kWeight / std::sqrt(1.01) / 4);
  EXPECT_LT(robot.currentAmperes(0), -0.5);
  EXPECT_GT(robot.velocityRpm(0), 300);
  EXPECT_LT(robot.currentVolts(0), Robot::kMiddle - 0.05);
}

/// @brief Driving backwards is symmetric to driving forwards.
TEST_F(RobotTest, OrientationTurnsEverything) {
  drive({.duty = 0.5, .backwards = false, .enabled = true});
  run(3000);
  Robot other(2);
  other.setNoise(false);
  other.setParameter(plant::Parameter::Battery, 0);
  for (std::size_t wheel = 0; wheel < plant::kWheels; ++wheel) {
    other.setWheel(wheel, {.duty = 0.5, .backwards = true, .enabled = true});
  }
  for (int i = 0; i < 3000; ++i) {
    static_cast<void>(other.step());
  }
  EXPECT_NEAR(other.velocityRpm(0), -robot.velocityRpm(0), 0.1);
  EXPECT_NEAR(other.distance(), -robot.distance(), 0.001);
  EXPECT_NEAR(other.currentVolts(3) - Robot::kMiddle, Robot::kMiddle - robot.currentVolts(3), 0.01);
}

/// @brief The simulation creates no energy. While the robot accelerates, its kinetic energy is
/// smaller than the energy that the supply delivers. While the robot coasts, the kinetic energy
/// only falls.
TEST_F(RobotTest, EnergyIsOnlyLost) {
  double supplied = 0;
  drive({.duty = 0.8, .backwards = false, .enabled = true});
  for (int i = 0; i < 2000; ++i) {
    run(1);
    supplied += 4 * 0.8 * 24 * robot.currentAmperes(0) * 0.001;
  }
  const auto moving = [&] { return Plant{}.mass * robot.groundSpeed() * robot.groundSpeed() / 2; };
  EXPECT_GT(supplied, moving());
  drive({.duty = 0, .backwards = false, .enabled = false});
  run(50);  // until the tyres have settled
  double before = moving();
  for (int i = 0; i < 20; ++i) {
    run(100);
    EXPECT_LE(moving(), before);
    before = moving();
  }
}

/// @brief A motor whose driver is off has no current. The robot then coasts far longer than with
/// short-circuited motors.
TEST_F(RobotTest, CoastingIsNotBraking) {
  const auto wayToRest = [](const WheelDrive& after) {
    Robot robot(1);
    for (int i = 0; i < 10'000; ++i) {
      for (std::size_t wheel = 0; wheel < plant::kWheels; ++wheel) {
        robot.setWheel(
            wheel, i < 3000 ? WheelDrive{.duty = 0.7, .backwards = false, .enabled = true} : after);
      }
      static_cast<void>(robot.step());
      if (i == 3000 && !after.enabled) {
        EXPECT_EQ(robot.currentAmperes(0), 0.0);
      }
    }
    EXPECT_EQ(robot.groundSpeed(), 0.0);
    EXPECT_EQ(robot.velocityRpm(1), 0.0);
    return robot.distance();
  };
  const double braked = wayToRest({.duty = 0, .backwards = false, .enabled = true});
  const double coasted = wayToRest({.duty = 0, .backwards = false, .enabled = false});
  EXPECT_GT(coasted, braked + 0.3);
}

/// @brief A robot at rest does not move until the force exceeds its rolling resistance.
TEST_F(RobotTest, StandsUntilTheForceExceedsStaticFriction) {
  drive({.duty = 0.02, .backwards = false, .enabled = true});
  run(2000);
  EXPECT_LT(std::abs(robot.distance()), 0.001);
  drive({.duty = 0.2, .backwards = false, .enabled = true});
  run(2000);
  EXPECT_GT(robot.distance(), 0.1);
}

/// @brief On a slope of 4 percent, the robot is at rest without current. On a slope of 20 percent,
/// the robot rolls down.
TEST_F(RobotTest, RollsDownASteepSlope) {
  robot.setSlope(4);
  run(3000);
  EXPECT_LT(std::abs(robot.distance()), 0.005);
  robot.setSlope(20);
  run(2000);
  EXPECT_LT(robot.distance(), -0.1);
}

/// @brief The robot reaches a slope axle by axle. While the robot drives fast, its slope
/// changes linearly over one wheelbase of 1.582 m. If the robot drives slowly or is at rest, the
/// change takes 2 s.
TEST_F(RobotTest, ASlopeBeginsAxleByAxle) {
  robot.setSlope(2);
  EXPECT_EQ(robot.slope(), 0);
  run(1000);
  EXPECT_NEAR(robot.slope(), 1, 0.01);
  run(1001);
  EXPECT_EQ(robot.slope(), 2);
  drive({.duty = 1.0, .backwards = false, .enabled = true});
  run(6000);
  const double begin = robot.distance();
  robot.setSlope(-2);
  run(500);
  EXPECT_NEAR(robot.slope(), 2 - 4 * (robot.distance() - begin) / 1.582, 0.02);
  EXPECT_LT(robot.slope(), 1);
  run(1500);
  EXPECT_EQ(robot.slope(), -2);
}

/// @brief A turn of the motor causes 60 edges, in the sequence that belongs to the direction of the
/// turn.
TEST_F(RobotTest, SixtyEdgesInATurn) {
  drive({.duty = 0.5, .backwards = false, .enabled = true});
  run(4000);
  const double rolled = robot.distance() / (2 * std::numbers::pi * DriveTrain::kRadius) * 10;
  const int forwards = netEdges(1);
  EXPECT_NEAR(forwards, 60 * rolled, 0.02 * 60 * rolled);
  EXPECT_GT(forwards, 60 * rolled) << "slip";
  const std::size_t before = edges.size();
  const double from = robot.distance();
  drive({.duty = 0.5, .backwards = true, .enabled = true});
  run(6000);
  EXPECT_GT(edges.size(), before);
  const double back = (robot.distance() - from) / (2 * std::numbers::pi * DriveTrain::kRadius) * 10;
  EXPECT_NEAR(netEdges(1) - forwards, 60 * back, 0.02 * 60 * std::abs(back));
}

/// @brief At a constant speed, the time between two edges is constant. The time of each edge is
/// within the time step that returns the edge.
TEST_F(RobotTest, EdgesAreEven) {
  drive({.duty = 0.5, .backwards = false, .enabled = true});
  run(4000);
  std::vector<double> times;
  for (int step = 0; step < 1000; ++step) {
    for (const HallEdge& edge : robot.step()) {
      EXPECT_GT(edge.offset.count(), 0);
      EXPECT_LE(edge.offset, Robot::kStep);
      if (edge.wheel == 0) {
        times.push_back(step * 1e6 + static_cast<double>(edge.offset.count()));
      }
    }
  }
  const double expected =
      1e9 / robot.velocityRpm(0);  // with 60 edges per turn, 1 rpm is one edge per second
  ASSERT_GT(times.size(), 100U);
  for (std::size_t i = 1; i < times.size(); ++i) {
    EXPECT_NEAR(times[i] - times[i - 1], expected, 0.01 * expected);
  }
}

/// @brief The same seed always causes the same noise, even if a sensor is read more often. Other
/// seeds cause other noise.
TEST_F(RobotTest, NoiseBelongsToTheSeed) {
  const auto signature = [](std::uint32_t seed, bool asksMore) {
    Robot robot(seed);
    double sum = 0;
    for (int i = 1; i <= 2000; ++i) {
      for (std::size_t wheel = 0; wheel < plant::kWheels; ++wheel) {
        robot.setWheel(wheel, {.duty = 0.5, .backwards = false, .enabled = true});
      }
      for (const HallEdge& edge : robot.step()) {
        sum += static_cast<double>(edge.offset.count()) * i;
      }
      sum += robot.currentVolts(1) * i + robot.steeringVolts();
      if (asksMore) {
        static_cast<void>(robot.steeringVolts());
      }
    }
    return sum;
  };
  EXPECT_EQ(signature(1, false), signature(1, true));
  EXPECT_NE(signature(1, false), signature(2, false));
}

/// @brief The current sensors have a noise of 50 mA, and the angle sensor has a noise of 0.05
/// degree. The mean of the noise is 0.
TEST_F(RobotTest, NoiseHasTheSizeOfTheSensors) {
  robot.setNoise(true);
  constexpr int kSamples = 10'000;
  double current = 0;
  double currentSquares = 0;
  double angle = 0;
  double angleSquares = 0;
  for (int i = 0; i < kSamples; ++i) {
    static_cast<void>(robot.step());
    const double amperes = (robot.currentVolts(2) - Robot::kMiddle) / Robot::kPerAmpere;
    const double degrees =
        (robot.steeringVolts() - Robot::kMiddle) / Robot::kReference * Robot::kAngleRange;
    current += amperes;
    currentSquares += amperes * amperes;
    angle += degrees;
    angleSquares += degrees * degrees;
  }
  EXPECT_NEAR(current / kSamples, 0, 0.003);
  EXPECT_NEAR(std::sqrt(currentSquares / kSamples), 0.05, 0.003);
  EXPECT_NEAR(angle / kSamples, 0, 0.003);
  EXPECT_NEAR(std::sqrt(angleSquares / kSamples), 0.05, 0.003);
}

/// @brief Each step turns the steering by 0.05 degree, up to the ends of its range. At each end,
/// the end stop is reached.
TEST_F(RobotTest, SteeringTurnsByStepsToItsEnds) {
  robot.setSteeringEnabled(true);
  for (int i = 0; i < 200; ++i) {
    robot.steeringStep(true);
  }
  EXPECT_NEAR(robot.steeringDegrees(), 10.0, 1e-9);
  static_cast<void>(robot.step());
  EXPECT_NEAR(robot.steeringVolts(), 1.65 + 10.0 * 3.3 / 80, 1e-9);
  EXPECT_FALSE(robot.leftEnd());
  for (int i = 0; i < 470; ++i) {
    robot.steeringStep(true);
  }
  EXPECT_TRUE(robot.leftEnd());
  EXPECT_NEAR(robot.steeringDegrees(), 33.5, 1e-9);
  for (int i = 0; i < 100; ++i) {
    robot.steeringStep(true);
  }
  EXPECT_NEAR(robot.steeringDegrees(), 34.0, 1e-9);
  for (int i = 0; i < 2000; ++i) {
    robot.steeringStep(false);
  }
  EXPECT_NEAR(robot.steeringDegrees(), -34.0, 1e-9);
  EXPECT_TRUE(robot.rightEnd());
  EXPECT_FALSE(robot.leftEnd());
}

/// @brief Steps are lost while the steering motor is off or stalled.
TEST_F(RobotTest, StepsAreLostWithoutCurrentAndWhenStalled) {
  robot.steeringStep(true);
  EXPECT_EQ(robot.steeringDegrees(), 0.0);
  robot.setSteeringEnabled(true);
  robot.setFault(Fault::Stall, 0, true);
  robot.steeringStep(true);
  EXPECT_EQ(robot.steeringDegrees(), 0.0);
  robot.setFault(Fault::Stall, 0, false);
  robot.steeringStep(true);
  EXPECT_NEAR(robot.steeringDegrees(), 0.05, 1e-9);
}

/// @brief A dead Hall sensor keeps its level. The other sensors continue to work.
TEST_F(RobotTest, DeadHallSensors) {
  robot.setFault(Fault::Hall, 0, true);
  robot.setFault(Fault::HallB, 1, true);
  drive({.duty = 0.5, .backwards = false, .enabled = true});
  run(2000);
  std::array<std::array<int, 2>, plant::kWheels> counts{};
  for (const HallEdge& edge : edges) {
    ++counts.at(edge.wheel).at(edge.sensor);
  }
  EXPECT_EQ(counts[0], (std::array<int, 2>{0, 0}));
  EXPECT_GT(counts[1][0], 100);
  EXPECT_EQ(counts[1][1], 0);
  EXPECT_GT(counts[2][1], 100);
  robot.setFault(Fault::Hall, 0, false);
  edges.clear();
  run(100);
  EXPECT_GT(netEdges(0), 5);
}

/// @brief A sensor with a broken cable has 0 V.
TEST_F(RobotTest, BrokenCables) {
  robot.setFault(Fault::Current, 3, true);
  robot.setFault(Fault::Angle, 0, true);
  run(1);
  EXPECT_EQ(robot.currentVolts(3), 0.0);
  EXPECT_EQ(robot.currentVolts(2), Robot::kMiddle);
  EXPECT_EQ(robot.steeringVolts(), 0.0);
}

/// @brief The current of a blocked wheel is limited only by the resistance of its motor.
TEST_F(RobotTest, BlockedWheelDrawsAllCurrent) {
  robot.setFault(Fault::Block, 1, true);
  drive({.duty = 1.0, .backwards = false, .enabled = true});
  run(100);
  EXPECT_EQ(robot.velocityRpm(1), 0.0);
  EXPECT_NEAR(robot.currentAmperes(1), 24.0 / 1.42, 0.1);
}

/// @brief Four blocked wheels load a battery with a resistance of 0.03 ohm. The voltage of the
/// battery falls from 24 V to 22.13 V. Without load, it is 24 V again.
TEST_F(RobotTest, BatterySagsUnderLoad) {
  robot.setParameter(plant::Parameter::Battery, 0.03);
  for (std::size_t wheel = 0; wheel < plant::kWheels; ++wheel) {
    robot.setFault(Fault::Block, wheel, true);
  }
  drive({.duty = 1.0, .backwards = false, .enabled = true});
  run(100);
  EXPECT_NEAR(robot.supplyVolts(), 22.13, 0.02);  // 24 V / (1 + 4 * 0.03 ohm / 1.42 ohm)
  drive({.duty = 0, .backwards = false, .enabled = true});
  run(100);
  EXPECT_NEAR(robot.supplyVolts(), 24.0, 0.01);
}

/// @brief The same seed always selects the same robot. Other seeds select other robots. The
/// parameters of a hundred robots are within the ranges on the page about the simulated robot.
TEST_F(RobotTest, VariedRobotsLieInTheirBands) {
  double lowest = 100;
  double highest = 0;
  for (std::uint32_t seed = 1; seed <= 100; ++seed) {
    Robot varied(seed);
    varied.vary(true);
    const Plant& plant = varied.plant();
    lowest = std::min(lowest, plant.supply);
    highest = std::max(highest, plant.supply);
    EXPECT_GE(plant.supply, 21);
    EXPECT_LE(plant.supply, 29);
    EXPECT_GE(plant.mass, 99);
    EXPECT_LE(plant.mass, 298);
    for (const MotorParameters& motor : plant.motors) {
      EXPECT_GE(motor.resistance, 1.13);
      EXPECT_LE(motor.resistance, 1.78);
      EXPECT_GE(motor.constant, 0.467);
      EXPECT_LE(motor.constant, 0.573);
      EXPECT_GE(motor.rotorInertia, 0.75e-3);
      EXPECT_LE(motor.rotorInertia, 3e-3);
    }
    Robot same(seed);
    same.vary(true);
    EXPECT_EQ(same.plant().supply, plant.supply);
  }
  EXPECT_LT(lowest, 21.5);
  EXPECT_GT(highest, 28.5);
}

/// @brief Both front wheels move on circles around the same centre. At a steering angle of 32
/// degrees, the inner wheel is turned by 38.3 degrees, and the outer wheel is turned by 27.3
/// degrees (cot outer - cot inner = track / wheelbase).
TEST_F(RobotTest, FrontWheelsTurnAboutOnePoint) {
  plant::SteeringLinkage linkage;
  linkage.turn(32);
  const auto degrees = [&](std::size_t wheel) {
    return std::atan2(linkage.pose(wheel).sine, linkage.pose(wheel).cosine) * 180 /
           std::numbers::pi;
  };
  const auto cotangent = [&](std::size_t wheel) {
    return linkage.pose(wheel).cosine / linkage.pose(wheel).sine;
  };
  EXPECT_NEAR(cotangent(1) - cotangent(0), 1.054 / 1.582, 1e-9);
  EXPECT_NEAR((cotangent(0) + cotangent(1)) / 2, 1 / std::tan(32 * std::numbers::pi / 180), 1e-9);
  EXPECT_NEAR(degrees(0), 38.3, 0.1);
  EXPECT_NEAR(degrees(1), 27.3, 0.1);
  EXPECT_EQ(degrees(2), 0);
  EXPECT_EQ(degrees(3), 0);
}

// A robot that drives a curve to the left, with a steering angle of 32 degrees. The fixture
// controls the velocity of each wheel.
class CurveTest : public RobotTest {
 protected:
  CurveTest() {
    robot.setSteeringEnabled(true);
    for (int i = 0; i < 640; ++i) {
      robot.steeringStep(true);
    }
  }

  void follow(const std::array<double, plant::kWheels>& rpm, int ms) {
    for (int i = 0; i < ms; ++i) {
      for (std::size_t wheel = 0; wheel < plant::kWheels; ++wheel) {
        const double error = rpm.at(wheel) - robot.velocityRpm(wheel);
        integrals_.at(wheel) = std::clamp(integrals_.at(wheel) + 2e-4 * error, -1.0, 1.0);
        const double duty = std::clamp(integrals_.at(wheel) + 0.005 * error, -1.0, 1.0);
        robot.setWheel(wheel, {.duty = std::abs(duty), .backwards = duty < 0, .enabled = true});
      }
      static_cast<void>(robot.step());
    }
  }

 private:
  std::array<double, plant::kWheels> integrals_{};
};

// Relative distances of the wheels from the centre of the curve. The middle of the rear axle has
// the relative distance 1. At a steering angle of 32 degrees, this is a distance of 1.582 m / tan
// 32 degrees = 2.532 m.
constexpr std::array<double, plant::kWheels> kGeometry{1.008, 1.360, 0.792, 1.208};

/// @brief With set-points that match the geometry of the curve, the robot drives the geometric
/// curve, and the wheels do not work against each other.
TEST_F(CurveTest, GeometryGivesTheCurveWithoutFight) {
  follow({100 * kGeometry[0], 100 * kGeometry[1], 100 * kGeometry[2], 100 * kGeometry[3]}, 8000);
  const double rear = 100.0 / 600 * 2 * std::numbers::pi * DriveTrain::kRadius;
  EXPECT_NEAR(robot.yawRate(), rear / 2.532, 0.03 * rear / 2.532);
  for (std::size_t wheel = 0; wheel < plant::kWheels; ++wheel) {
    EXPECT_LT(std::abs(robot.currentAmperes(wheel)), 2.5) << wheel;
    EXPECT_LT(std::abs(robot.sideSlip(wheel)), 0.02) << wheel;
  }
}

/// @brief With equal set-points in a curve, the wheels work against each other: one wheel brakes
/// with more than 2 A, and one wheel pulls with more than 5 A.
TEST_F(CurveTest, EqualVelocitiesFight) {
  follow({100, 100, 100, 100}, 8000);
  double greatest = 0;
  double least = 0;
  for (std::size_t wheel = 0; wheel < plant::kWheels; ++wheel) {
    greatest = std::max(greatest, robot.currentAmperes(wheel));
    least = std::min(least, robot.currentAmperes(wheel));
  }
  EXPECT_GT(greatest, 5);
  EXPECT_LT(least, -2);
}

/// @brief In a curve, the robot turns about a vertical axis, in the direction of the steering.
TEST_F(CurveTest, SteeringTurnsTheRobot) {
  follow({50, 50, 50, 50}, 3000);
  EXPECT_GT(robot.yawRate(), 0.02);
  EXPECT_GT(robot.heading(), 0.03);
}

/// @brief The slope belongs to the ground. The robot first drives uphill. After half a turn, it
/// drives downhill.
TEST_F(CurveTest, SlopeBelongsToTheGround) {
  robot.setSlope(4);
  const std::array<double, plant::kWheels> rpm{100 * kGeometry[0], 100 * kGeometry[1],
                                               100 * kGeometry[2], 100 * kGeometry[3]};
  const auto meanCurrent = [&] {
    double sum = 0;
    for (std::size_t wheel = 0; wheel < plant::kWheels; ++wheel) {
      sum += robot.currentAmperes(wheel);
    }
    return sum / 4;
  };
  follow(rpm, 3000);
  const double uphill = meanCurrent();
  while (robot.heading() < std::numbers::pi) {
    follow(rpm, 100);
  }
  EXPECT_GT(uphill, meanCurrent() + 1.0);
}

/// @brief With swapped leads, a forward voltage turns the wheel backwards. The current sensor still
/// measures the current of the driver.
TEST_F(RobotTest, SwappedLeadsTurnTheMotorRound) {
  robot.setFault(Fault::Leads, 2, true);
  robot.setWheel(2, {.duty = 0.2, .backwards = false, .enabled = true});
  run(20);
  EXPECT_LT(robot.velocityRpm(2), 0);
  EXPECT_LT(robot.torque(2), 0);
  EXPECT_GT(robot.currentVolts(2), Robot::kMiddle);
}

/// @brief With swapped Hall sensors, a forward rotation is counted backwards.
TEST_F(RobotTest, SwappedHallSensorsCountBackwards) {
  robot.setFault(Fault::HallSwapped, 1, true);
  drive({.duty = 0.5, .backwards = false, .enabled = true});
  run(2000);
  EXPECT_GT(netEdges(0), 100);
  EXPECT_NEAR(netEdges(1), -netEdges(0), 0.02 * netEdges(0));
}

/// @brief If a sensor is displaced by 30 electrical degrees, the distances between edges are 60 and
/// 120 electrical degrees.
TEST_F(RobotTest, MisplacedSensorMakesShortGaps) {
  robot.setFault(Fault::HallMisplaced, 0, true, 30);
  drive({.duty = 0.5, .backwards = false, .enabled = true});
  run(4000);
  std::vector<double> times;
  for (int step = 0; step < 1000; ++step) {
    for (const HallEdge& edge : robot.step()) {
      if (edge.wheel == 0) {
        times.push_back(step * 1e6 + static_cast<double>(edge.offset.count()));
      }
    }
  }
  const double even = 1e9 / robot.velocityRpm(0);
  ASSERT_GT(times.size(), 100U);
  for (std::size_t i = 2; i < times.size(); ++i) {
    const double gap = times[i] - times[i - 1];
    EXPECT_NEAR(std::min(gap, 2 * even - gap), even * 60 / 90, 0.02 * even);
  }
}

/// @brief The fault `hall-glitches` adds pulses of 30 us to sensor a, at the given rate. The fault
/// `hall-losses` removes edges at the given rate.
TEST_F(RobotTest, GlitchesAndLostEdges) {
  robot.setFault(Fault::HallGlitches, 0, true, 50);
  run(10'000);
  EXPECT_NEAR(static_cast<double>(edges.size()), 2 * 500, 2 * 70);
  for (std::size_t i = 1; i < edges.size(); i += 2) {
    EXPECT_EQ(edges[i].offset - edges[i - 1].offset, std::chrono::microseconds(30));
    EXPECT_EQ(edges[i].sensor, 0U);
  }
  robot.setFault(Fault::HallGlitches, 0, false);
  robot.setFault(Fault::HallLosses, 1, true, 20);
  edges.clear();
  drive({.duty = 0.5, .backwards = false, .enabled = true});
  run(10'000);
  const auto ofWheel = [&](std::size_t wheel) {
    return std::ranges::count(edges, wheel, &HallEdge::wheel);
  };
  EXPECT_NEAR(static_cast<double>(ofWheel(0) - ofWheel(1)), 200, 50);
}

/// @brief A stuck current sensor keeps its value. The value of a sensor with an offset contains the
/// offset.
TEST_F(RobotTest, StuckAndOffsetCurrentSensors) {
  run(1);
  robot.setFault(Fault::CurrentStuck, 0, true);
  robot.setFault(Fault::CurrentOffset, 1, true, 5000);
  robot.setFault(Fault::Block, 0, true);
  run(1);
  EXPECT_EQ(robot.currentVolts(1), Robot::kMiddle + 0.5);
  drive({.duty = 1.0, .backwards = false, .enabled = true});
  run(100);
  EXPECT_GT(robot.currentAmperes(0), 15);
  EXPECT_EQ(robot.currentVolts(0), Robot::kMiddle);
  robot.setFault(Fault::CurrentStuck, 0, false);
  run(1);
  EXPECT_GT(robot.currentVolts(0), Robot::kMiddle + 1);
}

/// @brief The converter converts another input directly before an open current input. The voltage
/// of the open input approaches the voltage of this other input.
TEST_F(RobotTest, OpenCurrentInputFollowsItsNeighbour) {
  robot.setFault(Fault::CurrentOffset, 0, true, 8000);
  robot.setFault(Fault::CurrentOpen, 1, true);
  robot.setFault(Fault::Angle, 0, true);
  robot.setFault(Fault::CurrentOpen, 2, true);
  run(500);
  EXPECT_NEAR(robot.currentVolts(1), robot.currentVolts(0), 1e-6);
  EXPECT_NEAR(robot.currentVolts(2), 0, 1e-6);
  robot.setFault(Fault::CurrentOpen, 1, false);
  run(1);
  EXPECT_EQ(robot.currentVolts(1), Robot::kMiddle);
}

/// @brief The converter converts another input directly before an open angle input. The voltage of
/// the open input approaches the voltage of this other input. A stuck sensor keeps its value. The
/// error of a drifting sensor grows at its rate.
TEST_F(RobotTest, AngleThatIsOpenStuckOrDrifts) {
  robot.setSteeringEnabled(true);
  for (int i = 0; i < 400; ++i) {
    robot.steeringStep(true);
  }
  run(1);
  EXPECT_NEAR(robot.steeringVolts(), 1.65 + 20 * 3.3 / 80, 1e-9);
  robot.setFault(Fault::AngleStuck, 0, true);
  for (int i = 0; i < 400; ++i) {
    robot.steeringStep(false);
  }
  run(100);
  EXPECT_NEAR(robot.steeringVolts(), 1.65 + 20 * 3.3 / 80, 1e-9);
  robot.setFault(Fault::AngleStuck, 0, false);
  EXPECT_NEAR(robot.steeringVolts(), 1.65, 1e-9);
  robot.setFault(Fault::AngleDrift, 0, true, 200);
  run(1000);
  EXPECT_NEAR(robot.steeringVolts(), 1.65 + 2 * 3.3 / 80, 1e-6);
  robot.setFault(Fault::AngleDrift, 0, false);
  robot.setFault(Fault::CurrentOffset, 3, true, 8000);
  robot.setFault(Fault::AngleOpen, 0, true);
  run(500);
  EXPECT_NEAR(robot.steeringVolts(), 2.45, 0.01);
}

/// @brief The contact of an end stop is open when the end stop is reached, and when its wire is
/// broken.
TEST_F(RobotTest, BrokenWireOfAnEndStopIsOpen) {
  EXPECT_FALSE(robot.leftEnd());
  robot.setFault(Fault::LeftEnd, 0, true);
  EXPECT_TRUE(robot.leftEnd());
  EXPECT_FALSE(robot.rightEnd());
  robot.setFault(Fault::RightEnd, 0, true);
  EXPECT_TRUE(robot.rightEnd());
}

/// @brief The emergency stop removes all torque, independent of the firmware, and opens its
/// contact. If the emergency stop also short-circuits the motors, the robot stops sooner.
TEST_F(RobotTest, EmergencyStopTakesAllTorque) {
  const auto wayAfter = [](plant::EmergencyStop state) {
    Robot driven(1);
    for (std::size_t wheel = 0; wheel < plant::kWheels; ++wheel) {
      driven.setWheel(wheel, {.duty = 0.6, .backwards = false, .enabled = true});
    }
    for (int i = 0; i < 3000; ++i) {
      static_cast<void>(driven.step());
    }
    EXPECT_FALSE(driven.emergencyStopOpen());
    EXPECT_FALSE(driven.braking());
    driven.setEmergencyStop(state);
    EXPECT_TRUE(driven.emergencyStopOpen());
    const double from = driven.distance();
    for (int i = 0; i < 10'000; ++i) {
      static_cast<void>(driven.step());
      EXPECT_LE(driven.torque(2), i < 10 ? 2.0 : 0.0);
      EXPECT_TRUE(i < 10 || driven.braking());
    }
    EXPECT_EQ(driven.groundSpeed(), 0.0);
    driven.steeringStep(true);
    EXPECT_EQ(driven.steeringDegrees(), 0.0);
    return driven.distance() - from;
  };
  EXPECT_GT(wayAfter(plant::EmergencyStop::Coast), wayAfter(plant::EmergencyStop::Brake) + 0.2);
}

/// @brief The robot stores its greatest velocity until clearGreatestVelocity() is called.
TEST_F(RobotTest, GreatestVelocityIsKept) {
  drive({.duty = 0.5, .backwards = true, .enabled = true});
  run(2000);
  const double top = std::abs(robot.velocityRpm(0));
  drive({.duty = 0, .backwards = true, .enabled = true});
  run(2000);
  EXPECT_GE(robot.greatestRpm(), top);
  robot.clearGreatestVelocity();
  run(1);
  EXPECT_LT(robot.greatestRpm(), 1);
}

/// @brief The grip limits the force of a tyre. With little grip, the wheels spin.
TEST_F(RobotTest, TyresSlipBeyondTheLimitOfFriction) {
  plant::Ground ice;
  ice.grip = 0.05;
  Robot slippery(1, ice);
  for (int i = 0; i < 500; ++i) {
    for (std::size_t wheel = 0; wheel < plant::kWheels; ++wheel) {
      slippery.setWheel(wheel, {.duty = 1.0, .backwards = false, .enabled = true});
    }
    static_cast<void>(slippery.step());
  }
  EXPECT_GT(slippery.velocityRpm(0), 380);
  EXPECT_LT(slippery.groundSpeed(), 0.05 * Robot::kGravity * 0.5 + 0.01);
}

}  // namespace
}  // namespace wr::test
