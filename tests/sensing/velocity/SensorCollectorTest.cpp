#include "sensing/velocity/SensorCollector.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "sensing/instants/BasicCollector.hpp"
#include "sensing/instants/CountCollector.hpp"
#include "sensing/velocity/TurningWheel.hpp"

namespace wr::test {
namespace {

class SensorCollectorTest : public testing::Test {
 protected:
  /// Generates an edge at a given time after the previous edge.
  void edge(std::uint8_t phase, std::int64_t microseconds = 10000) {
    at = at + Microseconds(microseconds);
    collector.collect(phase, at);
  }

  [[nodiscard]] int count() { return collector.record().instants.count; }
  [[nodiscard]] std::uint32_t unclear() { return collector.record().unclear; }
  [[nodiscard]] std::uint32_t reversals() { return collector.record().reversals; }

  Instant at{};
  BasicCollector basic;
  CountCollector counter{basic};
  SensorCollector collector{counter};
};

/// @brief Before the first edge, the record is empty. The levels of the sensors at the start do not
/// count as an edge.
/// @verifies FR-121
TEST_F(SensorCollectorTest, FR121_FirstLevelsAreNoEdge) {
  EXPECT_FALSE(collector.record().instants.last);
  edge(3);
  EXPECT_FALSE(collector.record().instants.last);
  EXPECT_EQ(count(), 0);
  EXPECT_EQ(unclear() + reversals(), 0U);
}

/// @brief The sequence of levels 0, 1, 3, 2 means forwards. The sequence may begin at any of these
/// levels. The reverse sequence means backwards.
/// @verifies FR-121
TEST_F(SensorCollectorTest, FR121_TellsTheDirection) {
  const std::array<std::uint8_t, 4> forwards = {0, 1, 3, 2};
  edge(2);
  int expected = 0;
  for (int turn = 0; turn < 3; ++turn) {
    for (const std::uint8_t phase : forwards) {
      edge(phase);
      EXPECT_EQ(count(), ++expected);
    }
  }
  for (int turn = 0; turn < 6; ++turn) {
    for (const std::uint8_t phase :
         {std::uint8_t{3}, std::uint8_t{1}, std::uint8_t{0}, std::uint8_t{2}}) {
      edge(phase);
      EXPECT_EQ(count(), --expected);
    }
  }
  EXPECT_EQ(unclear(), 0U);
}

/// @brief An edge counts as rising when the level of its sensor becomes high. This is true for both
/// directions of the wheel.
/// @verifies FR-121
TEST(HallEdges, FR121_EdgeRisesWithItsLevel) {
  // Records whether each edge rises.
  class Rises final : public InstantCollector {
   public:
    void collect(const Edge& edge) override { rising.push_back(edge.rising); }
    void fill(Instants& /*instants*/) const override {}
    std::vector<bool> rising;
  };
  Rises rises;
  SensorCollector collector(rises);
  for (const int phase : {0, 1, 3, 2, 0, 2, 3, 1, 0}) {
    collector.collect(static_cast<std::uint8_t>(phase), Instant());
  }
  EXPECT_EQ(rises.rising, (std::vector{true, true, false, false, true, true, false, false}));
}

/// @brief The record contains the time of the last edge.
/// @verifies FR-120
TEST_F(SensorCollectorTest, FR120_TellsTheLastEdge) {
  edge(0);
  edge(1);
  EXPECT_EQ(collector.record().instants.last, at);
}

/// @brief An interrupt without a changed level is rejected.
/// @verifies FR-123
TEST_F(SensorCollectorTest, FR123_RejectsNoChange) {
  edge(1);
  edge(1);
  EXPECT_EQ(count(), 0);
  EXPECT_EQ(unclear(), 1U);
}

/// @brief A change of both levels is rejected, because its direction is unknown. Later edges are
/// compared with the new levels.
/// @verifies FR-123
TEST_F(SensorCollectorTest, FR123_RejectsDoubleChange) {
  edge(0);
  edge(3);
  edge(2);
  EXPECT_EQ(count(), 1);
  edge(1);
  edge(0);
  EXPECT_EQ(count(), 0);
  EXPECT_EQ(unclear(), 2U);
}

/// @brief Each step is counted, even directly after the previous step.
/// @verifies FR-121
TEST_F(SensorCollectorTest, FR121_CountsEachStepHoweverSoon) {
  edge(0);
  edge(1);
  edge(3, 1);
  edge(2, 1);
  EXPECT_EQ(count(), 3);
  EXPECT_EQ(unclear() + reversals(), 0U);
}

/// @brief If a step reverses the direction within 25 ms, it is counted as a step and as an
/// implausible reversal. No turning wheel can cause such a reversal. After 25 ms, a reversal is
/// plausible.
/// @verifies FR-123
TEST_F(SensorCollectorTest, FR123_CountsFastReversals) {
  edge(0);
  edge(1);
  edge(0, 25000);
  EXPECT_EQ(reversals(), 0U);
  edge(1, 24999);
  EXPECT_EQ(reversals(), 1U);
  EXPECT_EQ(count(), 1);
  edge(3, 1000);
  EXPECT_EQ(reversals(), 1U) << "the same direction as before";
}

/// @brief A short disturbance on the wire of one sensor does not change the position.
/// @verifies FR-121
/// @verifies FR-123
TEST_F(SensorCollectorTest, FR123_DisturbanceLeavesThePosition) {
  edge(0);
  edge(1);
  edge(0, 3);
  edge(1, 3);
  EXPECT_EQ(count(), 1);
  EXPECT_EQ(reversals(), 2U);
  EXPECT_EQ(unclear(), 0U);
}

/// @brief At each edge of either sensor, the interrupt passes the edge to the collector. The edges
/// of both sensors are acknowledged.
/// @verifies FR-121
/// @verifies FR-123
TEST(HallInterrupt, FR121_EdgeOfEitherSensorIsCollected) {
  TurningWheel wheel;
  EXPECT_TRUE(wheel.a.started);
  EXPECT_TRUE(wheel.b.started);
  wheel.turn(0, milliseconds(5));
  wheel.edge(1);
  EXPECT_EQ(wheel.collector.record().instants.count, 1);
  EXPECT_EQ(wheel.collector.record().instants.last, wheel.time.now());
  wheel.turn(0, milliseconds(5));
  wheel.edge(1);
  EXPECT_EQ(wheel.collector.record().instants.count, 2);
  EXPECT_EQ(wheel.collector.record().unclear, 0U);
  EXPECT_FALSE(wheel.a.pending);
  EXPECT_FALSE(wheel.b.pending);
}

/// @brief An interrupt of another pin of the port does not count as an edge of this wheel.
/// @verifies FR-123
TEST(HallInterrupt, FR123_InterruptOfAnotherPinIsNoEdge) {
  TurningWheel wheel;
  wheel.active.serve();
  EXPECT_EQ(wheel.collector.record().unclear, 0U);
}

/// @brief If two edges occur before one interrupt, they count as one edge at which both levels
/// changed.
/// @verifies FR-123
TEST(HallInterrupt, FR123_TwoEdgesBeforeOneInterrupt) {
  TurningWheel wheel;
  wheel.turn(0, milliseconds(5));
  wheel.show(3);
  EXPECT_EQ(wheel.collector.record().unclear, 1U);
  EXPECT_EQ(wheel.collector.record().instants.count, 0);
}

}  // namespace
}  // namespace wr::test
