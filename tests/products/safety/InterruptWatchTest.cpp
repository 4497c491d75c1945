#include "safety/InterruptWatch.hpp"

#include <gtest/gtest.h>

namespace wr::test {
namespace {

class WatchedInterrupts : public testing::Test {
 protected:
  void tick(Microseconds after, bool edgeWaits = false) {
    now_ = now_ + after;
    watch_.tick(now_, edgeWaits);
  }

  void ticks(int count, bool edgeWaits) {
    for (int number = 0; number < count; ++number) {
      tick(milliseconds(1), edgeWaits);
    }
  }

 private:
  Instant now_{};
  InterruptWatch watch_;
};

/// @brief A tick is in time if it is at most 20 ms after the previous tick. If a tick is later, the
/// program ends. The first tick is always in time.
/// @verifies FR-308
TEST_F(WatchedInterrupts, FR308_ALateTickEndsTheProgram) {
  tick(milliseconds(500));
  tick(milliseconds(20));
  tick(milliseconds(20));
  EXPECT_DEATH(tick(milliseconds(20) + Microseconds(1)), "assertion 7 failed");
}

/// @brief If an edge waits for its interrupt at five successive ticks, the program ends. If an edge
/// waits at only four successive ticks, the program continues, however often this occurs.
/// @verifies FR-308
TEST_F(WatchedInterrupts, FR308_AnEdgeThatWaitsTooLongEndsTheProgram) {
  for (int number = 0; number < 100; ++number) {
    ticks(4, true);
    ticks(1, false);
  }
  ticks(4, true);
  EXPECT_DEATH(ticks(1, true), "assertion 7 failed");
}

}  // namespace
}  // namespace wr::test
