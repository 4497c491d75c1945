#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "sim/host/HostAnalogInput.hpp"
#include "sim/host/HostDigitalOutput.hpp"
#include "sim/host/HostEdgeInput.hpp"
#include "sim/host/HostPins.hpp"
#include "sim/host/HostPwmOutput.hpp"
#include "sim/host/HostScheduler.hpp"
#include "sim/host_robot/HostWires.hpp"
#include "sim/plant/Robot.hpp"

namespace wr::test {
namespace {

/// @brief A PWM output limits its duty cycle to the valid range.
TEST(HostPwmOutputTest, KeepsWithinTheLimits) {
  host::HostPwmOutput output;
  EXPECT_EQ(output.dutyCycle(), DutyCycle(0));
  output.set(DutyCycle(2'500));
  EXPECT_EQ(output.dutyCycle(), DutyCycle(2'500));
  output.set(DutyCycle(10'001));
  EXPECT_EQ(output.dutyCycle(), DutyCycle(10'000));
  output.set(DutyCycle(-1));
  EXPECT_EQ(output.dutyCycle(), DutyCycle(0));
}

/// @brief An output calls its callback when it is switched on. It does not call the callback while
/// it stays on.
TEST(HostDigitalOutputTest, TellsWhenItGoesOn) {
  host::HostDigitalOutput output;
  output.set(true);
  int rises = 0;
  output.onRise([&] { ++rises; });
  output.set(true);
  EXPECT_EQ(rises, 0);
  output.set(false);
  output.set(true);
  output.set(false);
  output.set(true);
  EXPECT_EQ(rises, 2);
  EXPECT_TRUE(output.isOn());
}

/// @brief Each call returns the sample that the previous call requested: the voltage at the time of
/// the previous call.
TEST(HostAnalogInputTest, EachSampleIsThatOfTheCallBefore) {
  host::HostAnalogInput input;
  EXPECT_EQ(input.sample(), std::nullopt);
  input.drive(1.0);
  EXPECT_EQ(input.sample(), 2048);
  EXPECT_EQ(input.sample(), 4095);
  input.drive(-0.5);
  EXPECT_EQ(input.sample(), 4095);
  input.drive(0.25);
  EXPECT_EQ(input.sample(), 0);
  EXPECT_EQ(input.sample(), 1024);
}

/// @brief Edges cause interrupts only after the start of the input, and only when the level
/// changes.
TEST(HostEdgeInputTest, EdgesInterruptOnceStarted) {
  host::HostScheduler scheduler;
  host::HostEdgeInput input(scheduler);
  std::vector<bool> levels;
  input.connect([&] {
    if (input.acknowledge()) {
      levels.push_back(input.level());
    }
  });
  EXPECT_TRUE(input.level());
  input.drive(false);
  EXPECT_FALSE(input.acknowledge());
  input.start();
  input.drive(false);
  input.drive(true);
  input.drive(false);
  EXPECT_EQ(levels, (std::vector<bool>{true, false}));
  EXPECT_FALSE(input.acknowledge());
}

class HostWiresTest : public testing::Test {
 protected:
  HostWiresTest() {
    robot.setNoise(false);
    static_cast<void>(robot.step());  // samples without noise
  }

  std::optional<std::uint16_t> converted(host::HostAnalogInput& input) const {
    static_cast<void>(input.sample());
    return input.sample();
  }

  host::HostScheduler scheduler;
  host::HostPins pins{scheduler};
  plant::Robot robot{1};
  host_robot::HostWires binding{pins, robot};
};

/// @brief At rest, the inputs of the currents and of the steering angle are in the middle of their
/// ranges, and no end stop is reached.
TEST_F(HostWiresTest, AtRestAllIsInTheMiddle) {
  binding.measure();
  for (host::HostWheelPins& wheel : pins.wheels) {
    EXPECT_EQ(converted(wheel.current), 2048);
  }
  EXPECT_EQ(converted(pins.steering.angle), 2048);
  EXPECT_FALSE(pins.steering.leftEnd.level());
  EXPECT_FALSE(pins.steering.rightEnd.level());
}

/// @brief The pins of a wheel determine how this wheel turns.
TEST_F(HostWiresTest, WheelsTurnAsTheirPinsSay) {
  pins.wheels[0].pwm.set(DutyCycle(5'000));
  pins.wheels[0].enable.set(true);
  pins.wheels[1].pwm.set(DutyCycle(5'000));
  pins.wheels[1].enable.set(true);
  pins.wheels[1].orientation.set(true);
  pins.wheels[2].pwm.set(DutyCycle(5'000));
  binding.drive();
  for (int i = 0; i < 20; ++i) {
    static_cast<void>(robot.step());
  }
  binding.measure();
  EXPECT_GT(robot.velocityRpm(0), 10);
  EXPECT_LT(robot.velocityRpm(1), -10);
  EXPECT_NEAR(robot.velocityRpm(2), 0, 1);
  EXPECT_GT(converted(pins.wheels[0].current), 2300);
  EXPECT_LT(converted(pins.wheels[1].current), 1800);
  EXPECT_EQ(converted(pins.wheels[2].current), 2048);
}

/// @brief While the motor is on, each pulse turns the steering by one step. The direction output
/// determines the direction of the step.
TEST_F(HostWiresTest, PulsesTurnTheSteering) {
  const auto pulses = [this](int count) {
    for (int i = 0; i < count; ++i) {
      pins.steering.step.set(true);
      pins.steering.step.set(false);
    }
  };
  pulses(10);
  EXPECT_EQ(robot.steeringDegrees(), 0);
  pins.steering.enable.set(true);
  pins.steering.direction.set(true);
  pulses(100);
  EXPECT_NEAR(robot.steeringDegrees(), 5.0, 1e-9);
  binding.measure();
  EXPECT_EQ(converted(pins.steering.angle), 2048 + 256);
  pulses(1000);
  binding.measure();
  EXPECT_TRUE(pins.steering.leftEnd.level());
  pins.steering.direction.set(false);
  pulses(2000);
  binding.measure();
  EXPECT_FALSE(pins.steering.leftEnd.level());
  EXPECT_TRUE(pins.steering.rightEnd.level());
}

}  // namespace
}  // namespace wr::test
