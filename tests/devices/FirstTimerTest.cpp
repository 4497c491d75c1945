#include "devices/FirstTimer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace wr {
namespace {

class MockTimer : public PeriodicTimer {
 public:
  virtual ~MockTimer() = default;
  MOCK_METHOD(void, start, (Microseconds), (override));
  MOCK_METHOD(void, stop, (), (override));
  MOCK_METHOD(void, acknowledge, (), (override));
};

class MockCommand : public Command {
 public:
  virtual ~MockCommand() = default;
  MOCK_METHOD(void, execute, (), (override));
};

/// @brief The timer ticks once in each cycle period of 100 ms.
/// @verifies FR-1
TEST(FirstTimer, FR1_BeatsEvery100Milliseconds) {
  testing::StrictMock<MockTimer> timer;
  testing::StrictMock<MockCommand> command;
  FirstTimer firstTimer(timer, command);
  EXPECT_CALL(timer, start(milliseconds(100)));
  firstTimer.start();
}

/// @brief Each tick first acknowledges the timer, so that a tick during the command is not lost.
/// Then the tick executes the command once.
/// @verifies FR-1
TEST(FirstTimer, FR1_EachBeatExecutesTheCommandOnce) {
  testing::StrictMock<MockTimer> timer;
  testing::StrictMock<MockCommand> command;
  FirstTimer firstTimer(timer, command);
  const testing::InSequence sequence;
  EXPECT_CALL(timer, acknowledge());
  EXPECT_CALL(command, execute());
  firstTimer.expired();
}

}  // namespace
}  // namespace wr
