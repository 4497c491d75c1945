#include "reading-modes/Waypoints.hpp"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <vector>

#include "communication/serialization/OrderMessage.hpp"
#include "support/ChangedRobot.hpp"
#include "support/FakeSerialPort.hpp"
#include "support/FakeTimebase.hpp"

namespace wr::test {
namespace {

std::vector<std::uint8_t> position(std::int16_t x, std::int16_t y) {
  std::vector<std::uint8_t> bytes{165};
  for (const std::int16_t value : {x, y}) {
    bytes.push_back(static_cast<std::uint8_t>(value & 0xFF));
    bytes.push_back(static_cast<std::uint8_t>((value >> 8) & 0xFF));
  }
  std::uint8_t sum = 0;
  for (const std::uint8_t byte : bytes) {
    sum = static_cast<std::uint8_t>(sum ^ byte);
  }
  bytes.push_back(sum);
  return bytes;
}

class WaypointReaderTest : public testing::Test {
 protected:
  /// @brief Passes a position to the reader. Returns the steering angle of the resulting order, or
  /// no value if there is no order.
  std::optional<int> steeringAt(std::int16_t x, std::int16_t y) {
    give(position(x, y));
    reader.serve();
    OrderMessage order;
    if (!reader.available() || !order.readFrom(reader)) {
      return std::nullopt;
    }
    return order.setPoints().steering.count();
  }

  void give(const std::vector<std::uint8_t>& bytes) {
    port.received.insert(port.received.end(), bytes.begin(), bytes.end());
  }

  static constexpr std::array<FieldPoint, 2> kWay{{{300, 0}, {600, 50}}};
  FakeSerialPort port;
  FakeTimebase clock;
  WaypointReader reader{port, clock, kWay};
};

/// @brief Orders steer towards the next way-point. After the last way-point there are no orders.
TEST_F(WaypointReaderTest, SteersTowardsTheNextWaypoint) {
  EXPECT_EQ(steeringAt(0, 0), 0);
  EXPECT_EQ(steeringAt(100, 10), -286);
  EXPECT_EQ(steeringAt(290, 0), 924);
  EXPECT_EQ(steeringAt(590, 50), std::nullopt);
}

/// @brief Each position causes one order, which is valid for a short time. Damaged bytes cause no
/// order.
TEST_F(WaypointReaderTest, OldAndDamagedPositionsGiveNoOrder) {
  ASSERT_EQ(steeringAt(0, 0), 0);
  EXPECT_FALSE(reader.available());
  give(position(10, 0));
  reader.serve();
  ASSERT_TRUE(reader.available());
  clock.advance(milliseconds(201));
  EXPECT_FALSE(reader.available());
  std::vector<std::uint8_t> damaged = position(20, 0);
  damaged.at(2) ^= 1U;
  give(damaged);
  reader.serve();
  EXPECT_FALSE(reader.available());
}

/// @brief The changed firmware computes its orders from positions, which a receiver sends to the
/// second serial port. The reports contain the number of the mode.
TEST(WaypointsOnBoard, PositionsCommandTheRobot) {
  ChangedRobot robot("change_reading-modes");
  robot.connect();
  const auto at = [&robot](std::int16_t x, std::int16_t y) {
    robot.board().receiveOn(4, position(x, y));
    robot.silentCycle();
  };
  for (int cycle = 0; cycle < 12; ++cycle) {
    at(100, 10);
  }
  EXPECT_EQ(robot.report().source, static_cast<int>(Waypoints::kId));
  EXPECT_EQ(robot.report().steeringSetPoint, -286);
  EXPECT_EQ(robot.report().setPoint.at(0), WaypointReader::kVelocity.count());
  at(290, 0);
  EXPECT_EQ(robot.report().orderId, 1);
  EXPECT_EQ(robot.report().steeringSetPoint, 924);
}

}  // namespace
}  // namespace wr::test
