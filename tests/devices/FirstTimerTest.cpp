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

/// @brief start() starts the timer with the cycle period of 100 ms.
/// @verifies FR-1
TEST(FirstTimer, FR1_ClockPulseEvery100Milliseconds) {
  testing::StrictMock<MockTimer> timer;
  testing::StrictMock<MockCommand> command;
  FirstTimer firstTimer(timer, command);
  EXPECT_CALL(timer, start(milliseconds(100)));
  firstTimer.start();
}

/// @brief At each clock pulse, the timer is first acknowledged, so that a clock pulse during the
/// command is not lost. Then the command is executed once.
/// @verifies FR-1
TEST(FirstTimer, FR1_EachClockPulseExecutesTheCommandOnce) {
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
