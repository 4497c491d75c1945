#include "sim/host_robot/HostSimulation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>

#include "sim/host/HostSerialPort.hpp"
#include "sim/host_robot/HostSession.hpp"
#include "sim/scenario/PcFrames.hpp"

namespace wr::test {
namespace {

constexpr Instant at(std::uint64_t ms) {
  return Instant(ms * 1000);
}

// The whole firmware in the simulated robot, and a PC that sends an order in each cycle.
class HostSimulationTest : public testing::Test {
 protected:
  HostSimulationTest() { line.start(); }

  void connect() {
    line.send(pc.hello());
    line.runThroughPulse();
    for (const scenario::Bytes& body : scenario::bodies(line.takeSent())) {
      if (const auto welcome = scenario::welcomeOf(body)) {
        line.send(pc.confirm(welcome->session));
      }
    }
    line.runThroughPulse();
  }

  void cycles(int count, const scenario::PcOrder& order) {
    for (int i = 0; i < count; ++i) {
      line.send(pc.order(order));
      line.runThroughPulse();
      for (const scenario::Bytes& body : scenario::bodies(line.takeSent())) {
        if (const auto read = scenario::reportOf(body)) {
          report = *read;
        }
      }
    }
  }

  static scenario::PcOrder velocity(std::int16_t value) {
    scenario::PcOrder order{.id = 1};
    order.wheels.fill({0, value});
    return order;
  }

  host_robot::HostSession line;
  host_robot::HostSimulation& world = line.world;
  scenario::PcSender pc;
  scenario::PcReport report;
};

/// @brief Events are executed in the order of their times, up to the requested time.
TEST_F(HostSimulationTest, TimeStandsWhereItWasAskedFor) {
  world.runUntil(Instant(1'234'567));
  EXPECT_EQ(world.time.now(), Instant(1'234'567));
  const Instant pulse = world.nextPulse();
  EXPECT_GT(pulse, world.time.now());
  EXPECT_LE(pulse, world.time.now() + milliseconds(100));
  world.runUntil(pulse);
  EXPECT_EQ(world.nextPulse(), pulse + milliseconds(100));
  EXPECT_EQ(world.robot.watchdog().refreshes(), 13U);
  EXPECT_FALSE(world.robot.watchdog().missed());
}

/// @brief A robot without an order does not drive and does not steer.
TEST_F(HostSimulationTest, WithoutOrdersTheRobotStands) {
  connect();
  world.runUntil(at(5'000));
  EXPECT_EQ(world.physics.distance(), 0.0);
  EXPECT_EQ(world.physics.steeringDegrees(), 0.0);
}

/// @brief The firmware counts 60 edges per turn of the shaft, and measures the velocity of the
/// wheel.
TEST_F(HostSimulationTest, FirmwareCountsTheWayOfTheWheels) {
  connect();
  cycles(30, velocity(1000));
  const std::int32_t before = report.position.at(2);
  const double from = world.physics.turns(2);
  cycles(50, velocity(1000));
  const double turned = world.physics.turns(2) - from;
  EXPECT_GT(turned, 5);
  EXPECT_NEAR(report.position.at(2) - before, 60 * turned, 1.5);
  EXPECT_NEAR(report.velocity.at(2), 10 * world.physics.velocityRpm(2), 10);
}

/// @brief The remote control drives the robot through the pulses on its pins.
TEST_F(HostSimulationTest, RemoteControlDrivesTheRobot) {
  world.remoteControl.set(plant::Sticks{.velocity = 1.0 / 3, .steering = 0.25});
  world.runUntil(at(4'000));
  EXPECT_NEAR(world.physics.velocityRpm(3), 100, 4);  // the wheels work against each other
  EXPECT_NEAR(world.physics.steeringDegrees(), 8.0, 0.5);
  world.remoteControl.set(std::nullopt);
  world.runUntil(at(7'000));
  EXPECT_NEAR(world.physics.groundSpeed(), 0, 0.001);
}

/// @brief After a reset, new firmware starts. The robot continues to roll, and its pins have the
/// state that the new firmware sets.
TEST_F(HostSimulationTest, ResetStartsNewFirmwareInTheSameRobot) {
  connect();
  cycles(40, velocity(1000));
  const double before = world.physics.groundSpeed();
  ASSERT_GT(before, 0.2);
  world.reset(ResetCause::Watchdog);
  EXPECT_EQ(world.physics.groundSpeed(), before);
  EXPECT_FALSE(world.robot.pins().wheels[0].enable.isOn());
  connect();
  cycles(40, velocity(500));
  EXPECT_NEAR(world.physics.velocityRpm(0), 50, 2);
  EXPECT_NEAR(report.velocity.at(0), 500, 20);
}

/// @brief The emergency stop opens its contact. The pin is then high.
TEST_F(HostSimulationTest, EmergencyStopIsOnItsPin) {
  world.runUntil(at(10));
  EXPECT_FALSE(world.robot.pins().emergencyStop.level());
  world.physics.setEmergencyStop(plant::EmergencyStop::Coast);
  world.runUntil(at(12));
  EXPECT_TRUE(world.robot.pins().emergencyStop.level());
}

/// @brief In the first second after power-on, only the enable switch of the remote control has
/// pulses. The sticks have no pulses.
TEST_F(HostSimulationTest, OnlyTheEnableSwitchSendsAtFirst) {
  int rises = 0;
  bool high = false;
  for (std::uint64_t ms = 1; ms <= 1000; ++ms) {
    world.runUntil(at(ms));
    const bool level = world.robot.pins().remoteControl[2].level();
    rises += level && !high ? 1 : 0;
    high = level;
    EXPECT_FALSE(world.robot.pins().remoteControl[0].level());
    EXPECT_FALSE(world.robot.pins().remoteControl[1].level());
  }
  EXPECT_NEAR(rises, 50, 1);
}

/// @brief In two runs with the same inputs, the robot has exactly the same distance and velocity.
TEST_F(HostSimulationTest, RunsRepeatExactly) {
  host::HostSerialPort port;
  host_robot::HostSimulation other(port);
  host_robot::HostSimulation third(port);
  const auto run = [](host_robot::HostSimulation& robot) {
    robot.remoteControl.set(plant::Sticks{.velocity = 0.5, .steering = -0.5});
    robot.runUntil(at(3'000));
    EXPECT_GT(robot.physics.distance(), 0.5);
    return robot.physics.distance() + robot.physics.velocityRpm(1);
  };
  other.start();
  third.start();
  EXPECT_EQ(run(other), run(third));
}

}  // namespace
}  // namespace wr::test
