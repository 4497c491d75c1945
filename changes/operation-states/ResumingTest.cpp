#include "operation-states/SixStates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <vector>

#include "steering_control/SteeringFakes.hpp"
#include "support/ChangedRobot.hpp"

namespace wr::test {
namespace {

/// @brief Each of the six states has a different number.
TEST(Resuming, HasANumberOfItsOwn) {
  FakeOutput lamp;
  const SixStates states(lamp);
  const std::set<OperationStateId> numbers{states.waiting.id(),      states.working.id(),
                                           states.waitingK.id(),     states.waitingN.id(),
                                           states.reconnecting.id(), states.resuming.id()};
  EXPECT_EQ(numbers.size(), 6U);
}

/// @brief After the search for a source of orders, the robot stands still for one cycle in the new
/// state. Then it is in the state Working.
TEST(ResumingOnBoard, HoldsForACycleAfterTheSearch) {
  ChangedRobot robot("change_operation-states");
  robot.connect();
  std::vector<int> states;
  for (int cycle = 0; cycle < 20; ++cycle) {
    robot.order({.id = 5});
    robot.cycle();
    states.push_back(robot.report().state);
    if (states.back() == static_cast<int>(Resuming::kId)) {
      EXPECT_TRUE(robot.report().held());
    }
  }
  const auto resuming = std::ranges::find(states, static_cast<int>(Resuming::kId));
  ASSERT_NE(resuming, states.end());
  EXPECT_EQ(*std::prev(resuming), kReconnecting);
  EXPECT_EQ(*std::next(resuming), kWorking);
  EXPECT_EQ(std::ranges::count(states, static_cast<int>(Resuming::kId)), 1);
}

}  // namespace
}  // namespace wr::test
