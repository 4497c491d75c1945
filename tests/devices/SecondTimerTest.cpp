#include "devices/SecondTimer.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace wr {
namespace {

std::vector<std::string> events;

class LoggingTimer final : public PeriodicTimer {
 public:
  void start(Microseconds period) override { started = period; }
  void stop() override {}
  void acknowledge() override { events.emplace_back("acknowledge"); }

  Microseconds started{};
};

class LoggingCommand final : public Command {
 public:
  explicit LoggingCommand(std::string name) : name_(std::move(name)) {}
  void execute() override { events.push_back(name_); }

 private:
  std::string name_;
};

class SecondTimerTest : public testing::Test {
 protected:
  SecondTimerTest() { events.clear(); }

  LoggingTimer timer;
  SecondTimer secondTimer{timer};
};

/// @brief start() starts the timer with the tick period of 1 ms.
/// @verifies FR-100
TEST_F(SecondTimerTest, FR100_TicksEveryMillisecond) {
  secondTimer.start();
  EXPECT_EQ(timer.started, milliseconds(1));
}

/// @brief At each tick, the timer is first acknowledged, so that a tick during the commands is not
/// lost. Then each command is executed once, in the order in which the commands were added.
/// @verifies FR-100
TEST_F(SecondTimerTest, FR100_EachTickExecutesAllCommands) {
  LoggingCommand first("first");
  LoggingCommand second("second");
  secondTimer.add(first);
  secondTimer.add(second);
  secondTimer.expired();
  secondTimer.expired();
  const std::vector<std::string> tick = {"acknowledge", "first", "second"};
  std::vector<std::string> twice = tick;
  twice.insert(twice.end(), tick.begin(), tick.end());
  EXPECT_EQ(events, twice);
}

/// @brief A tick is acknowledged even if no command was added.
/// @verifies FR-100
TEST_F(SecondTimerTest, FR100_TickWithoutCommands) {
  secondTimer.expired();
  EXPECT_EQ(events, std::vector<std::string>{"acknowledge"});
}

/// @brief The timer accepts its maximum number of commands. With one more command, the program
/// ends.
/// @verifies FR-100
/// @verifies FR-176
TEST_F(SecondTimerTest, FR100_OneCommandTooMany) {
  LoggingCommand command("command");
  for (std::size_t i = 0; i < SecondTimer::kCapacity; ++i) {
    secondTimer.add(command);
  }
  secondTimer.expired();
  EXPECT_EQ(events.size(), SecondTimer::kCapacity + 1);
  EXPECT_DEATH(secondTimer.add(command), "assertion 6 failed");
}

}  // namespace
}  // namespace wr
