#include "functions/arguments/Arguments.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <optional>

#include "functions/arguments/BaseArguments.hpp"
#include "functions/arguments/RangeArguments.hpp"
#include "functions/arguments/ScaleArguments.hpp"

namespace wr {
namespace {

constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();

std::optional<std::int32_t> valueOf(const Arguments& arguments, ArgumentId id) {
  ArgumentValues values;
  arguments.fill(values);
  return values.has(id) ? std::optional(values[id]) : std::nullopt;
}

/// @brief The basic arguments contain only a raw value and a time.
/// @verifies FR-120
TEST(Arguments, FR120_BaseHasRawAndElapsed) {
  const BaseArguments base(-7, Microseconds(20));
  EXPECT_EQ(valueOf(base, ArgumentId::Raw), -7);
  EXPECT_EQ(valueOf(base, ArgumentId::Elapsed), 20);
  for (const ArgumentId other : {ArgumentId::Scale, ArgumentId::Divisor, ArgumentId::Offset,
                                 ArgumentId::Lowest, ArgumentId::Highest}) {
    EXPECT_FALSE(valueOf(base, other));
  }
}

/// @brief If a time is outside the range of an argument, the nearest time in the range is used.
/// @verifies FR-120
TEST(Arguments, FR120_TimeIsLimited) {
  EXPECT_EQ(valueOf(BaseArguments(0, Microseconds(std::int64_t{kMost} + 1)), ArgumentId::Elapsed),
            kMost);
  EXPECT_EQ(valueOf(BaseArguments(0, Microseconds(kMost)), ArgumentId::Elapsed), kMost);
  EXPECT_EQ(valueOf(BaseArguments(0, Microseconds(-1)), ArgumentId::Elapsed), 0);
}

/// @brief Each decorator adds its values to the values of the wrapped arguments. The order of the
/// decorators does not matter.
/// @verifies FR-120
/// @verifies FR-124
TEST(Arguments, FR120_DecoratorsAddUp) {
  const BaseArguments base(1, Microseconds(2));
  const ScaleArguments scale(base, 3, 4, 5);
  const RangeArguments rangeOutside(scale, 6, 7);
  const RangeArguments range(base, 6, 7);
  const ScaleArguments scaleOutside(range, 3, 4, 5);
  for (const Arguments* const all : {static_cast<const Arguments*>(&rangeOutside),
                                     static_cast<const Arguments*>(&scaleOutside)}) {
    EXPECT_EQ(valueOf(*all, ArgumentId::Raw), 1);
    EXPECT_EQ(valueOf(*all, ArgumentId::Elapsed), 2);
    EXPECT_EQ(valueOf(*all, ArgumentId::Scale), 3);
    EXPECT_EQ(valueOf(*all, ArgumentId::Divisor), 4);
    EXPECT_EQ(valueOf(*all, ArgumentId::Offset), 5);
    EXPECT_EQ(valueOf(*all, ArgumentId::Lowest), 6);
    EXPECT_EQ(valueOf(*all, ArgumentId::Highest), 7);
  }
  EXPECT_FALSE(valueOf(scale, ArgumentId::Lowest));
  EXPECT_FALSE(valueOf(range, ArgumentId::Scale));
}

/// @brief If there are two scales, the scale of the outermost decorator is used.
/// @verifies FR-120
TEST(Arguments, FR120_OutermostCounts) {
  const BaseArguments base(1, Microseconds(2));
  const ScaleArguments inner(base, 3, 4, 5);
  const ScaleArguments outer(inner, 30, 40, 50);
  EXPECT_EQ(valueOf(outer, ArgumentId::Scale), 30);
}

}  // namespace
}  // namespace wr
