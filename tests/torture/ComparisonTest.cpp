#include "torture/Comparison.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace wr::torture {
namespace {

using testing::HasSubstr;

constexpr Record kEntered{Kind::Entered, 20, 1, 0xE9, {}};
constexpr Record kLeft{Kind::Left, 20, 1, 0xE9, {}};
constexpr Record kEnd{Kind::Acted, static_cast<std::uint8_t>(Action::End), 0, 0, {}};

/// @brief Two runs with the same records in the same order do not differ.
TEST(TortureComparisonTest, SameRecordsDoNotDiffer) {
  EXPECT_EQ(firstDifference({kEntered, kLeft, kEnd}, {kEntered, kLeft, kEnd}), std::nullopt);
}

/// @brief If two runs have the same records in different orders, the runs differ at the first
/// position at which their records differ.
TEST(TortureComparisonTest, AnotherOrderDiffers) {
  EXPECT_EQ(firstDifference({kEntered, kLeft, kEnd}, {kEntered, kEnd, kLeft}), 1U);
}

/// @brief Two records differ if any member has different values in these records.
TEST(TortureComparisonTest, EachMemberCounts) {
  Record changed = kEntered;
  changed.kind = Kind::Left;
  EXPECT_EQ(firstDifference({kEntered}, {changed}), 0U);
  changed = kEntered;
  changed.detail = 21;
  EXPECT_EQ(firstDifference({kEntered}, {changed}), 0U);
  changed = kEntered;
  changed.depth = 2;
  EXPECT_EQ(firstDifference({kEntered}, {changed}), 0U);
  changed = kEntered;
  changed.link = 0xF9;
  EXPECT_EQ(firstDifference({kEntered}, {changed}), 0U);
  for (std::uint32_t& word : changed.words) {
    changed = kEntered;
    word = 1;
    EXPECT_EQ(firstDifference({kEntered}, {changed}), 0U);
  }
}

/// @brief When one of the two runs is shorter, the runs differ at the end of the shorter run.
TEST(TortureComparisonTest, AShorterRunDiffers) {
  EXPECT_EQ(firstDifference({kEntered, kLeft}, {kEntered}), 1U);
  EXPECT_EQ(firstDifference({}, {kEntered}), 0U);
  EXPECT_THAT(context({kEntered, kLeft}, {kEntered}, 1), HasSubstr("nothing more"));
}

/// @brief The context of a difference shows the records before the difference, and both records
/// that differ.
TEST(TortureComparisonTest, TheContextShowsBothRecords) {
  const std::string text = context({kEntered, kLeft}, {kEntered, kEnd}, 1);
  EXPECT_THAT(text, HasSubstr("0         enters exception 20"));
  EXPECT_THAT(text, HasSubstr("1 left    leaves exception 20"));
  EXPECT_THAT(text, HasSubstr("1 right acted end"));
}

/// @brief A record is printed with a name for each of its numbers. The names depend on the kind of
/// the record.
TEST(TortureComparisonTest, EachKindNamesItsNumbers) {
  constexpr std::array<std::uint32_t, 5> kWords{1, 2, 3, 4, 5};
  EXPECT_THAT(described({Kind::Entered, 20, 1, 0xE9, kWords}),
              HasSubstr("link E9, ICSR 1, SHCSR 2, IABR 3, ISPR 4, masks 5"));
  EXPECT_THAT(
      described({Kind::Acted, static_cast<std::uint8_t>(Action::SetGrouping), 0, 0, kWords}),
      HasSubstr("acted set grouping"));
  EXPECT_THAT(described({Kind::Fault, 3, 1, 0xF9, kWords}),
              HasSubstr("CFSR 1, HFSR 2, BFAR 3, PC 4, xPSR 5"));
  EXPECT_THAT(described({Kind::FpMode, 3, 1, 0xE9, kWords}), HasSubstr("FP mode in exception 3"));
  EXPECT_THAT(described({Kind::FpMode, 3, 1, 0xE9, kWords}), HasSubstr(", FPSCR 1"));
}

/// @brief A failed check of the program is reported with the expected and the actual value.
TEST(TortureComparisonTest, FailedChecksAreTold) {
  EXPECT_EQ(failedChecks({kEntered, kLeft, kEnd}), "");
  EXPECT_THAT(failedChecks({kEntered, {Kind::CheckFailed, 4, 1, 0xE9, {0xAB, 0xCD}}}),
              HasSubstr("check failed register 4, link E9, wanted AB, found CD"));
}

/// @brief A run is complete only when its last record is the record of the end.
TEST(TortureComparisonTest, ARunWithoutItsEndIsNotComplete) {
  EXPECT_TRUE(complete({kEntered, kLeft, kEnd}));
  EXPECT_FALSE(complete({kEntered, kLeft}));
  EXPECT_FALSE(complete({}));
}

/// @brief Only the entry and the exit of a handler count as exception events.
TEST(TortureComparisonTest, EntriesAndExitsAreCounted) {
  EXPECT_EQ(exceptionEvents({kEntered, kLeft, kEnd}), 2U);
}

}  // namespace
}  // namespace wr::torture
