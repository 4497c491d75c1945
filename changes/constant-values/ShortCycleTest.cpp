// The changed header is compiled in a namespace with another name, because the other tests use the
// unchanged header.
#include <gtest/gtest.h>

#include <compare>
#include <cstdint>

#define wr wr_of_short_cycle
#include "constant-values/src/services/SystemConstants.hpp"
#undef wr

namespace wr_of_short_cycle {
namespace {

/// @brief A cycle lasts 50 ms. The changed header contains static assertions about values that
/// depend on the cycle period. This file compiles only if these assertions are true.
TEST(ShortCycle, HasFiftyMilliseconds) {
  EXPECT_EQ(SystemConstants::instance().cyclePeriod(), milliseconds(50));
}

}  // namespace
}  // namespace wr_of_short_cycle
