#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "k64/BoardRobot.hpp"
#include "k64/DriverBoard.hpp"

namespace wr::test {
namespace {

struct Wire {
  char port;
  int number;
};

// The Hall sensors of the wheels, then the remote control: each edge interrupts.
constexpr std::array<Wire, 10> kEdgeInputs{{{'D', 0},
                                            {'D', 1},
                                            {'D', 2},
                                            {'D', 3},
                                            {'D', 4},
                                            {'D', 5},
                                            {'D', 6},
                                            {'D', 7},
                                            {'B', 18},
                                            {'B', 19}}};
constexpr std::array<Wire, 2> kEndStops{{{'A', 1}, {'C', 18}}};

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

  /// Edges of each input since the start of the test.
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

/// @brief Each edge of an input interrupts, the rising one and the falling one, and no other input has
/// an edge by it.
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

/// @brief Edges of several inputs of one port at the same time are each seen once.
/// @verifies FR-144
TEST_F(K64PortOnBoard, FR144_EdgesAtTheSameTimeAreAllSeen) {
  for (const Wire& wire : kEdgeInputs) {
    put(drivers, wire, true);
  }
  EXPECT_EQ(edges(), std::vector<int>(kEdgeInputs.size(), 1));
}

/// @brief Edges that follow each other by 20 us, which is faster than the wheels can turn, are all seen.
/// @verifies FR-144
TEST_F(K64PortOnBoard, FR144_FastEdgesAreAllSeen) {
  constexpr int kEdges = 1000;
  bool level = false;
  for (int edge = 0; edge < kEdges; ++edge) {
    level = !level;
    put(drivers, kEdgeInputs[2], level);
    drivers.run(nanoseconds(20'000));
  }
  EXPECT_EQ(edges().at(2), kEdges);
}

/// @brief The level of each input can be read, that of the end stops too, which do not interrupt.
/// @verifies FR-144
TEST_F(K64PortOnBoard, FR144_LevelsAreThoseOfThePins) {
  std::vector<std::uint16_t> expected(kEdgeInputs.size() + kEndStops.size(), 0);
  for (const Wire& wire : kEndStops) {
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
  for (const Wire& wire : kEndStops) {
    raise(wire);
  }
}

/// @brief A wheel that the PC lets turn is measured: its Hall sensors interrupt at each edge.
/// @verifies FR-144
TEST(K64PortInTheRobot, FR144_EdgesOfAWheelThatTurnsAreMeasured) {
  const PcOrder order{.id = 1, .wheels = {{{.quantity = 0, .value = 500}, {}, {}, {}}}};
  BoardRobot robot;
  robot.startUp();
  robot.commandByPc(order);
  for (int cycle = 0; cycle < 30; ++cycle) {
    robot.order(order);
    robot.cycle();
  }
  EXPECT_GT(robot.report().position[0], 10);
  EXPECT_NEAR(robot.report().velocity[0], 500, 100);
  EXPECT_EQ(robot.report().rejectedEdges[0], 0);
}

}  // namespace
}  // namespace wr::test
