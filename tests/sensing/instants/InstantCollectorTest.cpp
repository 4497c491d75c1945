#include "sensing/instants/InstantCollector.hpp"

#include <gtest/gtest.h>

#include "sensing/instants/BasicCollector.hpp"
#include "sensing/instants/CountCollector.hpp"
#include "sensing/instants/PeriodCollector.hpp"
#include "sensing/instants/WidthCollector.hpp"

namespace wr {
namespace {

Instants known(const InstantCollector& collector) {
  Instants instants;
  collector.fill(instants);
  return instants;
}

Edge rise(std::uint64_t at) {
  return {.at = Instant(at), .rising = true};
}

Edge fall(std::uint64_t at) {
  return {.at = Instant(at), .rising = false};
}

/// @brief The basic collector stores only the time of the last edge.
/// @verifies FR-120
TEST(InstantCollector, FR120_BasicKnowsTheLastEdge) {
  BasicCollector basic;
  EXPECT_FALSE(known(basic).last);
  basic.collect(rise(10));
  basic.collect({.at = Instant(30), .rising = false, .direction = 1});
  EXPECT_EQ(known(basic).last, Instant(30));
  EXPECT_FALSE(known(basic).period);
  EXPECT_FALSE(known(basic).width);
  EXPECT_EQ(known(basic).count, 0);
}

/// @brief A period is the time between the last two rising edges.
/// @verifies FR-55
TEST(InstantCollector, FR55_PeriodBetweenRisingEdges) {
  BasicCollector basic;
  PeriodCollector period(basic);
  period.collect(fall(5));
  period.collect(rise(10));
  period.collect(fall(12));
  EXPECT_FALSE(known(period).period);
  period.collect(rise(30));
  EXPECT_EQ(known(period).period, Microseconds(20));
  period.collect(fall(31));
  EXPECT_EQ(known(period).period, Microseconds(20));
  period.collect(rise(61));
  EXPECT_EQ(known(period).period, Microseconds(31));
  EXPECT_EQ(known(period).last, Instant(61));
}

/// @brief A width is the time from a rising edge to the next falling edge.
/// @verifies FR-52
TEST(InstantCollector, FR52_WidthOfTheLastPulse) {
  BasicCollector basic;
  WidthCollector width(basic);
  width.collect(rise(10));
  EXPECT_FALSE(known(width).width);
  width.collect(fall(25));
  EXPECT_EQ(known(width).width, Microseconds(15));
  width.collect(rise(100));
  EXPECT_EQ(known(width).width, Microseconds(15));
  width.collect(fall(102));
  EXPECT_EQ(known(width).width, Microseconds(2));
  EXPECT_EQ(known(width).last, Instant(102));
}

/// @brief A falling edge does not end a pulse if there was no rising edge before.
/// @verifies FR-52
TEST(InstantCollector, FR52_NoWidthWithoutWholePulse) {
  BasicCollector basic;
  WidthCollector width(basic);
  width.collect(fall(5));
  EXPECT_FALSE(known(width).width);
  width.collect(rise(10));
  width.collect(fall(25));
  width.collect(fall(40));
  EXPECT_FALSE(known(width).width);
}

/// @brief The count of a CountCollector is the sum of the directions of all edges.
/// @verifies FR-121
TEST(InstantCollector, FR121_CountIsTheSumOfDirections) {
  BasicCollector basic;
  CountCollector count(basic);
  for (const int direction : {1, 1, -1, 1, 0, -1, -1, -1}) {
    count.collect(
        {.at = Instant(1), .rising = true, .direction = static_cast<std::int8_t>(direction)});
  }
  EXPECT_EQ(known(count).count, -1);
  EXPECT_EQ(known(count).last, Instant(1));
}

/// @brief If several decorators are nested, the value of each decorator is available.
/// @verifies FR-52
/// @verifies FR-55
/// @verifies FR-121
TEST(InstantCollector, FR55_DecoratorsAddUp) {
  BasicCollector basic;
  PeriodCollector period(basic);
  WidthCollector width(period);
  CountCollector count(width);
  for (const Edge edge : {rise(0), fall(3), rise(20), fall(25)}) {
    count.collect(edge);
  }
  EXPECT_EQ(known(count).last, Instant(25));
  EXPECT_EQ(known(count).period, Microseconds(20));
  EXPECT_EQ(known(count).width, Microseconds(5));
  EXPECT_EQ(known(count).count, 0);
}

}  // namespace
}  // namespace wr
