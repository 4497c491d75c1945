#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "k64/BoardRobot.hpp"
#include "k64/DriverBoard.hpp"
#include "k64/patch.hpp"
#include "sim/board_robot/BoardSession.hpp"
#include "sim/scenario/Scenario.hpp"
#include "sim/scenario/ScenarioPlayer.hpp"
#include "support/image.hpp"

namespace wr::test {
namespace {

struct Wire {
  char port;
  int number;
};

// The inputs of the Hall sensors of the wheels, and then the inputs of the remote control. Each
// edge causes an interrupt.
constexpr std::array<Wire, 11> kEdgeInputs{{{'D', 0},
                                            {'D', 1},
                                            {'D', 2},
                                            {'D', 3},
                                            {'D', 4},
                                            {'D', 5},
                                            {'D', 6},
                                            {'D', 7},
                                            {'B', 18},
                                            {'B', 19},
                                            {'B', 23}}};
// The end stops, and the contact of the emergency stop.
constexpr std::array<Wire, 3> kContacts{{{'A', 1}, {'C', 18}, {'E', 25}}};

void put(DriverBoard& drivers, const Wire& wire, bool level) {
  drivers.board.drive(wire.port, wire.number, level);
}

class K64PortOnBoard : public testing::Test {
 protected:
  K64PortOnBoard() {
    for (const Wire& wire : kEdgeInputs) {
      put(drivers, wire, false);
    }
    drivers.startUp();
    before = drivers.ask('E');
  }

  /// Returns the number of edges of each input since the start of the test.
  std::vector<int> edges() {
    const std::vector<std::uint16_t> now = drivers.ask('E');
    std::vector<int> counts;
    for (std::size_t i = 0; i < now.size(); ++i) {
      counts.push_back(now[i] - before.at(i));
    }
    return counts;
  }

  DriverBoard drivers;
  std::vector<std::uint16_t> before;
};

/// @brief Each rising and each falling edge of an input causes an interrupt. The edge is not
/// counted at another input.
/// @verifies FR-144
TEST_F(K64PortOnBoard, FR144_BothEdgesOfEachInputInterrupt) {
  std::vector<int> expected(kEdgeInputs.size(), 0);
  for (std::size_t input = 0; input < kEdgeInputs.size(); ++input) {
    put(drivers, kEdgeInputs.at(input), true);
    ++expected.at(input);
    EXPECT_EQ(edges(), expected) << "rising edge of " << input;
    put(drivers, kEdgeInputs.at(input), false);
    ++expected.at(input);
    EXPECT_EQ(edges(), expected) << "falling edge of " << input;
  }
}

/// @brief Edges of several inputs of one port may occur at the same time. Each edge is detected
/// once.
/// @verifies FR-144
TEST_F(K64PortOnBoard, FR144_EdgesAtTheSameTimeAreAllSeen) {
  for (const Wire& wire : kEdgeInputs) {
    put(drivers, wire, true);
  }
  EXPECT_EQ(edges(), std::vector<int>(kEdgeInputs.size(), 1));
}

/// @brief If an input has four edges within a tick, all four edges are detected. A wheel at full
/// speed has far fewer edges.
/// @verifies FR-144
TEST_F(K64PortOnBoard, FR144_FourEdgesInATickAreAllSeen) {
  constexpr int kTicks = 100;
  bool level = false;
  for (int tick = 0; tick < kTicks; ++tick) {
    for (int edge = 0; edge < 4; ++edge) {
      level = !level;
      put(drivers, kEdgeInputs[2], level);
      drivers.run(nanoseconds(250'000));
    }
  }
  EXPECT_EQ(edges().at(2), 4 * kTicks);
}

/// @brief At most four edges of one input cause interrupts within a tick. In the next tick, edges
/// cause interrupts again. Other inputs are not affected.
/// @verifies FR-201
TEST_F(K64PortOnBoard, FR201_MoreEdgesInATickDoNotInterrupt) {
  constexpr int kTicks = 100;
  constexpr int kEdgesInATick = 50;
  bool level = false;
  for (int edge = 0; edge < kTicks * kEdgesInATick; ++edge) {
    level = !level;
    put(drivers, kEdgeInputs[2], level);
    put(drivers, kEdgeInputs[9], level);
    drivers.run(nanoseconds(20'000));
  }
  put(drivers, kEdgeInputs[3], true);
  const std::vector<int> seen = edges();
  EXPECT_LE(seen.at(2), 4 * (kTicks + 1));
  EXPECT_GE(seen.at(2), 4 * (kTicks - 1));
  EXPECT_LE(seen.at(9), 4 * (kTicks + 1));
  EXPECT_GE(seen.at(9), 4 * (kTicks - 1));
  EXPECT_EQ(seen.at(3), 1);
}

/// @brief A pulse of 0.5 us at a Hall sensor causes no edges. A pulse of 1 us causes edges.
/// @verifies FR-202
TEST_F(K64PortOnBoard, FR202_ShortPulsesAtHallSensorsHaveNoEdge) {
  const auto pulse = [this](nanoseconds width) {
    put(drivers, kEdgeInputs[4], true);
    drivers.run(width);
    put(drivers, kEdgeInputs[4], false);
    drivers.run(milliseconds(2));
  };
  for (int i = 0; i < 20; ++i) {
    pulse(nanoseconds(500));
  }
  EXPECT_EQ(edges().at(4), 0);
  pulse(nanoseconds(1000));
  EXPECT_GE(edges().at(4), 1);
}

// Returns the pulse widths of velocity, direction and enable in microseconds. After each edge, the
// interrupt handler of the program computes for some microseconds. This computation delays the next
// interrupt.
std::vector<std::uint16_t> widths(DriverBoard& drivers) {
  return drivers.ask('W');
}

/// @brief The width of a pulse of the remote control is measured with an accuracy of 1 us. This is
/// true even when another pulse ends at the beginning of this pulse, or when both pulses begin and
/// end at the same time.
/// @verifies FR-200
TEST_F(K64PortOnBoard, FR200_EdgesThatComeTogetherGetOneTime) {
  using std::chrono::microseconds;
  const Wire velocity = kEdgeInputs[8];
  const Wire direction = kEdgeInputs[9];
  const Wire enable = kEdgeInputs[10];
  const auto pulse = [this](const Wire& wire, microseconds from, microseconds width) {
    const nanoseconds begin = drivers.board.now() + from;
    drivers.board.driveAt(begin, wire.port, wire.number, true);
    drivers.board.driveAt(begin + width, wire.port, wire.number, false);
  };
  pulse(velocity, microseconds(100), microseconds(1500));
  pulse(direction, microseconds(1600), microseconds(1700));
  pulse(enable, microseconds(3300), microseconds(1900));
  drivers.run(milliseconds(10));
  std::vector<std::uint16_t> oneAfterAnother = widths(drivers);
  ASSERT_EQ(oneAfterAnother.size(), 3U);
  EXPECT_NEAR(oneAfterAnother[0], 1500, 1);
  EXPECT_NEAR(oneAfterAnother[1], 1700, 1);
  EXPECT_NEAR(oneAfterAnother[2], 1900, 1);
  pulse(velocity, microseconds(100), microseconds(1200));
  pulse(direction, microseconds(100), microseconds(1200));
  pulse(enable, microseconds(100), microseconds(1800));
  drivers.run(milliseconds(10));
  EXPECT_NEAR(widths(drivers)[0], 1200, 1);
  EXPECT_NEAR(widths(drivers)[1], 1200, 1);
  EXPECT_NEAR(widths(drivers)[2], 1800, 1);
}

/// @brief The level of each input can be read. This includes the end stops and the emergency stop,
/// which cause no interrupts.
/// @verifies FR-144
TEST_F(K64PortOnBoard, FR144_LevelsAreThoseOfThePins) {
  std::vector<std::uint16_t> expected(kEdgeInputs.size() + kContacts.size(), 0);
  for (const Wire& wire : kContacts) {
    put(drivers, wire, false);
  }
  EXPECT_EQ(drivers.ask('L'), expected);
  std::size_t place = 0;
  const auto raise = [&](const Wire& wire) {
    put(drivers, wire, true);
    expected.at(place) = 1;
    ++place;
    EXPECT_EQ(drivers.ask('L'), expected);
  };
  for (const Wire& wire : kEdgeInputs) {
    raise(wire);
  }
  for (const Wire& wire : kContacts) {
    raise(wire);
  }
}

/// @brief Noise of 200 kHz at all Hall sensors and all signals of the remote control does not delay
/// the cycles. Ten cycles run in a second, no cycle is late, and the watchdog does not reset the
/// board.
/// @verifies FR-201
TEST(K64PortInTheRobot, FR201_NoiseDoesNotStarveTheCycles) {
  BoardRobot robot;
  robot.startUp();
  bool noise = true;
  bool level = false;
  constexpr nanoseconds kHalfPeriod = nanoseconds(seconds(1)) / 200'000 / 2;
  robot.board.onTime(kHalfPeriod, [&] {
    level = !level;
    for (const Wire& wire : kEdgeInputs) {
      if (noise) {
        robot.board.drive(wire.port, wire.number, level);
      }
    }
  });
  robot.run(seconds(1));
  noise = false;
  EXPECT_EQ(robot.board.resets(), 0);
  EXPECT_EQ(robot.line.pulses().size(), 10U);
  robot.connect();
  EXPECT_EQ(robot.report().overruns, 0);
}

/// @brief If a pulse of the remote control begins when another pulse ends, one interrupt of the
/// robot serves both edges.
/// @verifies FR-200
TEST(K64PortInTheRobot, FR200_OneInterruptServesEdgesThatComeTogether) {
  constexpr std::uint32_t kEdgeException = exceptionOf(60);
  BoardRobot robot;
  robot.startUp();
  int interrupts = 0;
  robot.line.onEvent([&](const emulator::Event& event) {
    interrupts +=
        event.kind == emulator::Event::Kind::ExceptionEntered && event.number == kEdgeException ? 1
                                                                                                : 0;
  });
  robot.board.drive('B', 18, true);
  robot.run(milliseconds(1));
  EXPECT_EQ(interrupts, 1);
  robot.board.drive('B', 18, false);
  robot.board.drive('B', 19, true);
  robot.run(milliseconds(1));
  EXPECT_EQ(interrupts, 2);
}

/// @brief The velocity pulse begins at the same time as the direction pulse. The robot still
/// measures the right width of the direction pulse, even with a slow flash.
/// @verifies FR-200
TEST(K64PortInTheRobot, FR200_PulsesThatComeTogetherHaveTheirWidths) {
  // 1 us of the pulse is 0.064 degrees, and each edge of the pulse may be measured 1 us early or
  // late.
  std::istringstream text(
      "seed 5\nat 0 noise off\nat 0 rc coincident on\nat 0 rc enable drive\nat 0 rc velocity 0 "
      "steering 2000\nat 50 "
      "connect\n"
      "from 400 to 3000 every 400 keepalive\n"
      "from 1000 to 3000 every 100 expect steering_set_point between 1988 2012\nat 3100 end\n");
  const scenario::Scenario scenario(text, "coincident");
  for (const emulator::Timing timing :
       {emulator::Timing::NoWaitStates, emulator::Timing::SlowFlash}) {
    const auto robot = switchBoardOn({.timing = timing});
    const auto outcome = scenario::ScenarioPlayer(scenario, *robot).play();
    EXPECT_FALSE(outcome.finding.has_value());
    EXPECT_EQ(outcome.failures, std::vector<std::string>{});
  }
}

/// @brief A robot at rest counts no edges when its Hall sensors have pulses of 0.5 us.
/// @verifies FR-202
TEST(K64PortInTheRobot, FR202_ShortPulsesMoveNoWheel) {
  BoardRobot robot;
  robot.startUp();
  robot.connect();
  for (int pulse = 0; pulse < 100; ++pulse) {
    for (std::size_t sensor = 0; sensor < 8; ++sensor) {
      const Wire& wire = kEdgeInputs.at(sensor);
      const bool level = robot.board.pin(wire.port, wire.number);
      robot.board.drive(wire.port, wire.number, !level);
      robot.board.driveAt(robot.board.now() + nanoseconds(500), wire.port, wire.number, level);
    }
    robot.run(nanoseconds(100'000));
  }
  robot.silentCycles(2);
  for (std::size_t wheel = 0; wheel < 4; ++wheel) {
    EXPECT_EQ(robot.report().position.at(wheel), 0);
    EXPECT_EQ(robot.report().rejectedEdges.at(wheel), 0);
  }
}

/// @brief When orders of the PC turn the wheels, the velocity of the wheels is measured. Each edge
/// of their Hall sensors causes an interrupt.
/// @verifies FR-144
TEST(K64PortInTheRobot, FR144_EdgesOfAWheelThatTurnsAreMeasured) {
  scenario::PcOrder order{.id = 1};
  order.wheels.fill({.quantity = 0, .value = 500});
  BoardRobot robot;
  robot.startUp();
  robot.commandByPc(order);
  for (int cycle = 0; cycle < 30; ++cycle) {
    robot.order(order);
    robot.cycle();
  }
  for (std::size_t wheel = 0; wheel < 4; ++wheel) {
    EXPECT_GT(robot.report().position.at(wheel), 10);
    EXPECT_NEAR(robot.report().velocity.at(wheel), 500, 100);
    EXPECT_EQ(robot.report().rejectedEdges.at(wheel), 0);
  }
}

}  // namespace
}  // namespace wr::test
