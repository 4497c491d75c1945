#include "safety/WheelComparison.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>

#include "units/Measurements.hpp"

namespace wr::test {
namespace {

class ComparedWheels : public testing::Test {
 protected:
  ComparedWheels() {
    for (WheelMeasurements& wheel : measurements.wheels) {
      wheel.position = HallCount(0);
      wheel.current = Current(0);
    }
    EXPECT_EQ(comparison.behind(measurements), std::nullopt);
  }

  /// Runs a cycle in which each wheel moves by a number of edges.
  std::optional<std::uint8_t> move(const std::array<int, kWheelCount>& edges) {
    for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
      HallCount& position = *measurements.wheels[wheel].position;
      position = HallCount(static_cast<std::int32_t>(static_cast<std::uint32_t>(position.count()) +
                                                     static_cast<std::uint32_t>(edges[wheel])));
    }
    return comparison.behind(measurements);
  }

  std::optional<std::uint8_t> push(int current, std::size_t wheel = 1) {
    measurements.wheels[wheel].current = Current(current);
    return comparison.overloaded(measurements);
  }

  Measurements measurements;
  WheelComparison comparison;
};

/// @brief A wheel that does not move is detected after two comparisons. Each comparison lasts for
/// 20 edges of the other wheels. During both comparisons, the robot drives 0.114 m, because a wheel
/// with a radius of 0.272 m has 600 edges in a turn.
/// @verifies FR-297
TEST_F(ComparedWheels, FR297_AWheelWithoutMotionIsFound) {
  for (const int direction : {1, -1}) {
    comparison.reset();
    move({0, 0, 0, 0});
    for (int cycle = 1; cycle < 40; ++cycle) {
      EXPECT_EQ(move({direction, direction, 0, direction}), std::nullopt) << cycle;
    }
    EXPECT_EQ(move({direction, direction, 0, direction}), std::uint8_t{2});
  }
}

/// @brief Any of the four wheels is detected if it does not move. A check of the currents between
/// the two comparisons does not prevent this.
/// @verifies FR-297
TEST_F(ComparedWheels, FR297_EachWheelWithoutMotionIsFound) {
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    std::array<int, kWheelCount> edges{20, 20, 20, 20};
    edges.at(wheel) = 0;
    EXPECT_EQ(move(edges), std::nullopt) << wheel;
    EXPECT_EQ(comparison.overloaded(measurements), std::nullopt) << wheel;
    EXPECT_EQ(move(edges), static_cast<std::uint8_t>(wheel));
    comparison.reset();
    move({0, 0, 0, 0});
  }
}

/// @brief If the positions of the other wheels overflow, a wheel that does not move is still
/// detected.
/// @verifies FR-177
/// @verifies FR-297
TEST_F(ComparedWheels, FR297_PositionsContinueAtTheOtherEnd) {
  for (const int direction : {1, -1}) {
    for (WheelMeasurements& wheel : measurements.wheels) {
      wheel.position = HallCount(direction * (std::numeric_limits<std::int32_t>::max() - 15));
    }
    comparison.reset();
    move({0, 0, 0, 0});
    for (int cycle = 1; cycle < 40; ++cycle) {
      EXPECT_EQ(move({direction, direction, 0, direction}), std::nullopt) << cycle;
    }
    EXPECT_EQ(move({direction, direction, 0, direction}), std::uint8_t{2});
  }
}

/// @brief If a wheel stops moving, this is detected before the robot has driven 0.27 m. This is
/// tested at each speed up to 300 rpm (30 edges in a cycle), and at each moment of the failure. The
/// circumference of a wheel with a radius of 0.272 m has 600 edges.
/// @verifies FR-297
TEST_F(ComparedWheels, FR297_AWheelWithoutMotionIsFoundWithin27Centimetres) {
  constexpr double kMetresPerEdge = 2 * std::numbers::pi * 0.272 / 600;
  constexpr int kFastest = 300 * 60 / 600;  // 300 rpm: 60 edges in a turn, 600 cycles in a minute
  for (int speed = 1; speed <= kFastest; ++speed) {
    for (int before = 0; before <= 20 / speed; ++before) {
      for (int last = 0; last < speed; ++last) {
        comparison.reset();
        move({0, 0, 0, 0});
        for (int cycle = 0; cycle < before; ++cycle) {
          move({speed, speed, speed, speed});
        }
        int way = speed - last;  // edges since the failure
        std::optional<std::uint8_t> found = move({speed, speed, last, speed});
        for (; !found && way < 1000; way += speed) {
          found = move({speed, speed, 0, speed});
        }
        EXPECT_LE(way * kMetresPerEdge, 0.27) << speed << ' ' << before << ' ' << last;
      }
    }
  }
}

/// @brief A wheel that moves half as far as the other wheels is reported. A wheel that moves more
/// than half as far is not reported. A wheel that is faster than the other wheels is never
/// reported. A wheel that is too slow in only one comparison is not reported.
/// @verifies FR-297
TEST_F(ComparedWheels, FR297_HalfTheWayIsTheLimit) {
  for (int cycle = 0; cycle < 10; ++cycle) {
    EXPECT_EQ(move({26, 26, 14, 26}), std::nullopt);
    EXPECT_EQ(move({26, 80, 26, 26}), std::nullopt);
  }
  EXPECT_EQ(move({13, 26, 26, 26}), std::nullopt);
  EXPECT_EQ(move({14, 26, 26, 26}), std::nullopt);
  EXPECT_EQ(move({13, 26, 26, 26}), std::nullopt);
  EXPECT_EQ(move({13, 26, 26, 26}), std::uint8_t{0});
}

/// @brief Wheels 0 and 1 move too little in two successive comparisons. Wheel 1 moves least in the
/// first comparison, and wheel 0 moves least in the second comparison. One of these two wheels is
/// reported.
/// @verifies FR-297
TEST_F(ComparedWheels, FR297_ASlowWheelNeedNotBeTheSlowest) {
  EXPECT_EQ(move({2, 1, 80, 80}), std::nullopt);
  EXPECT_EQ(move({1, 2, 80, 80}), std::uint8_t{1});
}

/// @brief A wheel is reported if its sensors count in the wrong direction. If a position is
/// missing in one cycle, this does not cause a report. In the tightest curve, the wheels have
/// different velocities. No wheel is reported because of these differences.
/// @verifies FR-297
TEST_F(ComparedWheels, FR297_WrongAndMissingEdgesAreBehind) {
  for (int cycle = 0; cycle < 10; ++cycle) {
    EXPECT_EQ(move({74, 100, 58, 89}), std::nullopt);
    EXPECT_EQ(move({-74, -100, -58, -89}), std::nullopt);
  }
  EXPECT_EQ(move({30, 30, 30, -30}), std::nullopt);
  EXPECT_EQ(move({30, 30, 30, -30}), std::uint8_t{3});
  measurements.wheels[1].position.reset();
  EXPECT_EQ(comparison.behind(measurements), std::nullopt);
}

/// @brief A current of more than 11.0 A in ten successive cycles is too much, in either direction.
/// A current of 11.0 A is permitted. A cycle with less current restarts the count.
/// @verifies FR-298
TEST_F(ComparedWheels, FR298_AGreatCurrentMayNotLast) {
  for (const int sign : {1, -1}) {
    for (int cycle = 0; cycle < 30; ++cycle) {
      EXPECT_EQ(push(sign * 11000), std::nullopt);
    }
    for (int cycle = 0; cycle < 9; ++cycle) {
      EXPECT_EQ(push(sign * 11001), std::nullopt);
    }
    EXPECT_EQ(push(sign * 11000), std::nullopt);
    for (int cycle = 0; cycle < 9; ++cycle) {
      EXPECT_EQ(push(sign * 11001), std::nullopt);
    }
    EXPECT_EQ(push(sign * 11001), std::uint8_t{1});
  }
}

/// @brief The current of each wheel is supervised. A call of reset() restarts the counts.
/// @verifies FR-298
TEST_F(ComparedWheels, FR298_EachWheelIsCounted) {
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    for (int cycle = 0; cycle < 9; ++cycle) {
      EXPECT_EQ(push(12000, wheel), std::nullopt);
    }
    comparison.reset();
    for (int cycle = 0; cycle < 9; ++cycle) {
      EXPECT_EQ(push(12000, wheel), std::nullopt);
    }
    EXPECT_EQ(push(12000, wheel), static_cast<std::uint8_t>(wheel));
    push(0, wheel);
  }
}

/// @brief In a curve of 11.01 degrees or more, the set-points may make the wheels work against each
/// other. In such a curve, a current of more than 11.0 A causes a stop in the 50th cycle.
/// @verifies FR-298
TEST_F(ComparedWheels, FR298_InACurveAGreatCurrentMayLastLonger) {
  for (const int angle : {1101, -1101}) {
    measurements.steering = Angle(angle);
    for (int cycle = 0; cycle < 49; ++cycle) {
      EXPECT_EQ(push(14000), std::nullopt);
    }
    EXPECT_EQ(push(11000), std::nullopt);
  }
  for (int cycle = 0; cycle < 49; ++cycle) {
    EXPECT_EQ(push(-11001), std::nullopt);
  }
  EXPECT_EQ(push(-11001), std::uint8_t{1});
}

/// @brief A current of 14 A may last five times as long in a curve as at a steering angle of 11
/// degrees or less. Therefore, when the curve ends, a cycle with this current counts as five cycles
/// in a curve.
/// @verifies FR-298
TEST_F(ComparedWheels, FR298_TheEndOfACurveShortensTheTime) {
  for (const int angle : {-1100, 1100}) {
    comparison.reset();
    measurements.steering = Angle(1101);
    for (int cycle = 0; cycle < 45; ++cycle) {
      EXPECT_EQ(push(14000), std::nullopt);
    }
    measurements.steering = Angle(angle);
    EXPECT_EQ(push(14000), std::uint8_t{1}) << angle;
  }
}

}  // namespace
}  // namespace wr::test
