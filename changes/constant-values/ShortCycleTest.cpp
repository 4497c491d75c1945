// The changed header is compiled under another name of the namespace, because the other tests use
// the unchanged header.
#include <gtest/gtest.h>

#include <compare>
#include <cstdint>

#define wr wr_of_short_cycle
#include "constant-values/src/services/SystemConstants.hpp"
#undef wr

namespace wr_of_short_cycle {
namespace {

/// @brief A cycle lasts 50 ms, and the values that depend on it at compile time still fit.
TEST(ShortCycle, HasFiftyMilliseconds) {
  EXPECT_EQ(SystemConstants::instance().cyclePeriod(), milliseconds(50));
}

}  // namespace
}  // namespace wr_of_short_cycle
