#include "main_control/operation_states/OperationState.hpp"

#include "main_control/ControllerFixture.hpp"
#include "main_control/operation_states/Reconnecting.hpp"
#include "main_control/operation_states/Waiting.hpp"
#include "main_control/operation_states/WaitingN.hpp"
#include "main_control/operation_states/Working.hpp"
#include "services/SystemConstants.hpp"
#include "support/waitingCycles.hpp"

namespace wr::test {
namespace {

// The successors of each state are fake states. Each fake state records its steps. With these
// records, the test finds the current state.
class OperationStateTest : public ControllerFixture {
 protected:
  // Makes a state the current state of the controller.
  void enter(OperationState& entered) { controller.changeOpState(entered); }

  void read(bool message) {
    first.message = message;
    controller.read();
  }

  // Returns true if a fake state is the current state.
  bool isCurrent(FakeState& fake) {
    fake.steps.clear();
    controller.control();
    return fake.steps == std::vector<std::string>{"control"};
  }

  bool noneIsCurrent() { return !isCurrent(state) && !isCurrent(other); }
};

/// @brief The state Working reads a message, and remains the current state.
/// @verifies FR-13
TEST_F(OperationStateTest, FR13_WorkingReadsAndStays) {
  Working working(other);
  enter(working);
  read(true);
  EXPECT_EQ(first.reads, 1);
  EXPECT_TRUE(noneIsCurrent());
}

/// @brief When there is no message, the state Working reads nothing and sets the state Waiting.
/// @verifies FR-15
TEST_F(OperationStateTest, FR15_WorkingSetsWaiting) {
  Working working(other);
  enter(working);
  read(false);
  EXPECT_EQ(first.reads, 0);
  EXPECT_TRUE(isCurrent(other));
}

/// @brief The state Waiting remains the current state until the N-th failed read, and then sets the
/// state WaitingN. N includes the failed read that set the state Waiting.
/// @verifies FR-15
/// @verifies FR-16
TEST_F(OperationStateTest, FR16_WaitingCountsFailedReads) {
  Waiting waiting(state, other, SystemConstants::instance().waitingCycles());
  enter(waiting);
  for (int failed = 2; failed < kWaitingCycles; ++failed) {
    read(false);
    EXPECT_TRUE(noneIsCurrent()) << failed;
  }
  read(false);
  EXPECT_TRUE(isCurrent(other));
}

/// @brief The state Waiting reads a message and sets the state Working. When the state Waiting is
/// entered again, its count of failed reads begins at 1 again.
/// @verifies FR-13
/// @verifies FR-16
TEST_F(OperationStateTest, FR16_WaitingCountsAnewAfterAMessage) {
  Waiting waiting(state, other, SystemConstants::instance().waitingCycles());
  enter(waiting);
  read(false);
  read(true);
  EXPECT_EQ(first.reads, 1);
  EXPECT_TRUE(isCurrent(state));
  enter(waiting);
  for (int failed = 2; failed < kWaitingCycles; ++failed) {
    read(false);
  }
  EXPECT_TRUE(noneIsCurrent());
  read(false);
  EXPECT_TRUE(isCurrent(other));
}

/// @brief The state Waiting sets the state WaitingN at the end of its count of failed reads. When
/// the state Waiting is entered again, this count begins at 1 again.
/// @verifies FR-16
TEST_F(OperationStateTest, FR16_WaitingCountsAnewAfterItsEnd) {
  Waiting waiting(state, other, SystemConstants::instance().waitingCycles());
  for (int round = 0; round < 2; ++round) {
    enter(waiting);
    for (int failed = 2; failed < kWaitingCycles; ++failed) {
      read(false);
      EXPECT_TRUE(noneIsCurrent());
    }
    read(false);
    EXPECT_TRUE(isCurrent(other));
  }
}

/// @brief The state WaitingN reads a message and sets the state Working.
/// @verifies FR-13
TEST_F(OperationStateTest, FR13_WaitingNReadsAndSetsWorking) {
  WaitingN waitingN(state, other);
  enter(waitingN);
  read(true);
  EXPECT_EQ(first.reads, 1);
  EXPECT_TRUE(isCurrent(state));
}

/// @brief When there is no message, the state WaitingN sets the state Reconnecting. The mode does
/// not change.
/// @verifies FR-16
TEST_F(OperationStateTest, FR16_WaitingNSetsReconnecting) {
  WaitingN waitingN(state, other);
  enter(waitingN);
  read(false);
  EXPECT_TRUE(isCurrent(other));
  EXPECT_EQ(first.changes, 0);
}

/// @brief The state Reconnecting reads a message and sets the state Working. The mode does not
/// change.
/// @verifies FR-13
TEST_F(OperationStateTest, FR13_ReconnectingReadsAndSetsWorking) {
  Reconnecting reconnecting(state);
  enter(reconnecting);
  read(true);
  EXPECT_EQ(first.reads, 1);
  EXPECT_EQ(first.changes, 0);
  EXPECT_TRUE(isCurrent(state));
}

/// @brief The state Reconnecting changes the mode after each failed read, and remains the current
/// state.
/// @verifies FR-17
TEST_F(OperationStateTest, FR17_ReconnectingChangesTheMode) {
  Reconnecting reconnecting(state);
  first.next = &second;
  second.next = &first;
  enter(reconnecting);
  read(false);
  EXPECT_EQ(&controller.getMode(), &second);
  read(false);
  EXPECT_EQ(&controller.getMode(), &first);
  EXPECT_TRUE(noneIsCurrent());
}

/// @brief The state Reconnecting holds the control systems, even if there are set-points.
/// @verifies FR-18
TEST_F(OperationStateTest, FR18_ReconnectingHolds) {
  Reconnecting reconnecting(state);
  data.saveSetPoints({});
  reconnecting.control(controller);
  EXPECT_EQ(system.calls, kHeld);
}

/// @brief The states Working, Waiting and WaitingN apply the set-points that were read last.
/// @verifies FR-14
TEST_F(OperationStateTest, FR14_WorkingAndWaitingStatesApplyControl) {
  Working working(other);
  Waiting waiting(state, other, SystemConstants::instance().waitingCycles());
  WaitingN waitingN(state, other);
  data.saveSetPoints({.orderId = 5});
  for (OperationState* each :
       std::initializer_list<OperationState*>{&working, &waiting, &waitingN}) {
    system.calls.clear();
    each->control(controller);
    EXPECT_EQ(system.calls, kControlled);
    EXPECT_EQ(system.applied.orderId, 5);
  }
}

/// @brief Each operation state reports its number.
/// @verifies FR-61
TEST_F(OperationStateTest, FR61_EachStateReportsItsNumber) {
  Working working(other);
  Waiting waiting(state, other, SystemConstants::instance().waitingCycles());
  WaitingN waitingN(state, other);
  Reconnecting reconnecting(state);
  connect();
  int number = 0;
  for (OperationState* each :
       std::initializer_list<OperationState*>{&working, &waiting, &waitingN, &reconnecting}) {
    each->write(controller);
    EXPECT_EQ(sentReport().state, number);
    EXPECT_EQ(static_cast<int>(each->id()), number);
    ++number;
  }
}

}  // namespace
}  // namespace wr::test
