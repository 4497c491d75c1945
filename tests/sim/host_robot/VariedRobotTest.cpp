#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "sim/host_robot/HostSession.hpp"
#include "sim/scenario/PcFrames.hpp"

namespace wr::test {
namespace {

// The firmware in a robot whose parameters differ from the firmware's assumptions. A seed selects
// the parameters.
class VariedRobot : public testing::TestWithParam<std::uint32_t> {
 protected:
  VariedRobot() {
    robot().setSeed(GetParam());
    robot().vary(true);
    line.start();
    line.send(pc.hello());
    line.runThroughPulse();
    for (const scenario::Bytes& body : scenario::bodies(line.takeSent())) {
      if (const auto welcome = scenario::welcomeOf(body)) {
        line.send(pc.confirm(welcome->session));
      }
    }
    cycles(13, 0);
  }

  void cycles(int count, std::int16_t velocity) {
    scenario::PcOrder order{.id = 1};
    order.wheels.fill({0, velocity});
    for (int i = 0; i < count; ++i) {
      line.send(pc.order(order));
      line.runThroughPulse();
      static_cast<void>(line.takeSent());
    }
  }

  void silentCycles(int count) {
    for (int i = 0; i < count; ++i) {
      line.send(pc.keepAlive());
      line.runThroughPulse();
      static_cast<void>(line.takeSent());
    }
  }

  // Returns the greatest difference between the velocity of a wheel and a given velocity.
  [[nodiscard]] double greatestError(double rpm) {
    double greatest = 0;
    for (std::size_t wheel = 0; wheel < plant::kWheels; ++wheel) {
      greatest = std::max(greatest, std::abs(robot().velocityRpm(wheel) - rpm));
    }
    return greatest;
  }

  plant::Robot& robot() { return line.robot(); }

  host_robot::HostSession line;
  scenario::PcSender pc;
};

/// @brief The values of the motors, the battery and the load are random within their tolerances.
/// After 50 cycles with an order of 50 rpm or 150 rpm, the error of each wheel's velocity is less
/// than 5 %.
TEST_P(VariedRobot, VelocityIsReached) {
  cycles(50, 500);
  EXPECT_LT(greatestError(50), 0.05 * 50);
  cycles(50, 1500);
  EXPECT_LT(greatestError(150), 0.05 * 150);
}

/// @brief At the greatest velocity that can be ordered, no wheel turns faster than 330 rpm. After
/// the last order, the robot drives at most 1.5 m.
TEST_P(VariedRobot, StopsFromFullSpeed) {
  cycles(80, 3000);
  EXPECT_LT(robot().greatestRpm(), 330);
  EXPECT_GT(robot().groundSpeed(), 0.6);
  const double from = robot().distance();
  silentCycles(60);
  EXPECT_NEAR(robot().groundSpeed(), 0, 0.001);
  EXPECT_LT(robot().distance() - from, 1.5);
}

INSTANTIATE_TEST_SUITE_P(Seeds, VariedRobot, testing::Range(1U, 21U));

}  // namespace
}  // namespace wr::test
