#include "main_control/control_systems/ControlSystemPool.hpp"

#include <gtest/gtest.h>

#include "main_control/SpySystem.hpp"

namespace wr::test {
namespace {

class ControlSystemPoolTest : public testing::Test {
 protected:
  void addBoth() {
    pool.add(one);
    pool.add(two);
  }

  ControlSystemPool pool;
  SpySystem one;
  SpySystem two;
};

/// @brief When control() is called, each system measures, receives the set-points, and works.
/// @verifies FR-14
TEST_F(ControlSystemPoolTest, FR14_ControlReachesEachSystem) {
  addBoth();
  pool.control({.orderId = 3}, 17);
  for (const SpySystem* system : {&one, &two}) {
    EXPECT_EQ(system->calls, kControlled);
    EXPECT_EQ(system->applied.orderId, 3);
    EXPECT_EQ(system->cycle, 17U);
  }
}

/// @brief When hold() is called, each system measures, halts, and works.
/// @verifies FR-18
TEST_F(ControlSystemPoolTest, FR18_HoldReachesEachSystem) {
  addBoth();
  pool.hold(18);
  for (const SpySystem* system : {&one, &two}) {
    EXPECT_EQ(system->calls, kHeld);
    EXPECT_EQ(system->cycle, 18U);
  }
}

/// @brief The pool has completed a cycle when each system has completed the same cycle.
/// @verifies FR-5
TEST_F(ControlSystemPoolTest, FR5_CompletedWhenEachSystemIs) {
  EXPECT_TRUE(pool.completed(1));
  addBoth();
  pool.hold(1);
  EXPECT_TRUE(pool.completed(1));
  EXPECT_FALSE(pool.completed(2));
  one.completes = false;
  EXPECT_FALSE(pool.completed(1));
  one.completes = true;
  two.completes = false;
  EXPECT_FALSE(pool.completed(1));
}

/// @brief An empty pool has no measured values.
/// @verifies FR-62
TEST_F(ControlSystemPoolTest, FR62_EmptyPoolGivesNoValue) {
  Measurements measurements;
  Outputs outputs;
  pool.collect(measurements, outputs);
  EXPECT_EQ(measurements, Measurements{});
  EXPECT_EQ(outputs, Outputs{});
}

/// @brief The pool collects the values of its systems.
/// @verifies FR-62
TEST_F(ControlSystemPoolTest, FR62_PoolGathersValues) {
  pool.add(one);
  one.measured.steering = Angle(4);
  one.outputs.turn = std::int8_t{1};
  Measurements measurements;
  Outputs outputs;
  pool.collect(measurements, outputs);
  EXPECT_EQ(measurements.steering, Angle(4));
  EXPECT_EQ(outputs.turn, 1);
}

/// @brief If more systems are added than the pool can contain, the program ends.
/// @verifies FR-176
TEST_F(ControlSystemPoolTest, SystemTooManyEndsTheProgram) {
  for (std::size_t i = 0; i < ControlSystemPool::kCapacity; ++i) {
    pool.add(one);
  }
  EXPECT_DEATH(pool.add(two), "assertion 2 failed");
}

}  // namespace
}  // namespace wr::test
