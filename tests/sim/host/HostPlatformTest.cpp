#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "services/Command.hpp"
#include "services/SystemConstants.hpp"
#include "sim/host/HostScheduler.hpp"
#include "sim/host/HostSerialPort.hpp"
#include "sim/host/HostThread.hpp"
#include "sim/host/HostTimebase.hpp"
#include "sim/host/HostTimer.hpp"
#include "sim/host/HostWatchdog.hpp"
#include "sim/scenario/PcFrames.hpp"
#include "support/LineBytes.hpp"

namespace wr::test {
namespace {

class Body final : public Command {
 public:
  explicit Body(std::function<void()> action) : action_(std::move(action)) {}
  void execute() override { action_(); }

 private:
  std::function<void()> action_;
};

class HostSchedulerTest : public testing::Test {
 protected:
  using Log = std::vector<std::string>;

  Log log;
  host::HostScheduler scheduler;
  host::HostThread low{scheduler, 1};
  host::HostThread high{scheduler, 2};
  host::HostThread alsoHigh{scheduler, 2};
};

/// @brief If a thread posts a thread of higher priority, the posted thread runs immediately, before
/// the post returns.
TEST_F(HostSchedulerTest, HigherPriorityRunsAtOnce) {
  Body highBody([&] { log.emplace_back("high"); });
  Body lowBody([&] {
    log.emplace_back("low begins");
    high.post();
    log.emplace_back("low ends");
  });
  high.start(highBody);
  low.start(lowBody);
  low.post();
  EXPECT_EQ(log, (Log{"low begins", "high", "low ends"}));
}

/// @brief Threads of equal or lower priority run after the running thread has ended, in the order
/// of their priorities.
TEST_F(HostSchedulerTest, OthersRunAfterTheRunningOne) {
  Body lowBody([&] { log.emplace_back("low"); });
  Body alsoHighBody([&] { log.emplace_back("also high"); });
  Body highBody([&] {
    low.post();
    alsoHigh.post();
    log.emplace_back("high ends");
  });
  low.start(lowBody);
  high.start(highBody);
  alsoHigh.start(alsoHighBody);
  high.post();
  EXPECT_EQ(log, (Log{"high ends", "also high", "low"}));
}

/// @brief If an interrupt posts a thread, the thread runs after the interrupt.
TEST_F(HostSchedulerTest, ThreadRunsAfterTheInterrupt) {
  Body highBody([&] { log.emplace_back("high"); });
  high.start(highBody);
  scheduler.interrupt([&] {
    high.post();
    log.emplace_back("interrupt ends");
  });
  EXPECT_EQ(log, (Log{"interrupt ends", "high"}));
}

/// @brief A thread that posts itself runs once more, after its present activation.
TEST_F(HostSchedulerTest, ThreadThatPostsItselfRunsAgain) {
  int runs = 0;
  Body body([&] {
    log.emplace_back("begin");
    if (++runs == 1) {
      low.post();
    }
    log.emplace_back("end");
  });
  low.start(body);
  low.post();
  EXPECT_EQ(log, (Log{"begin", "end", "begin", "end"}));
  EXPECT_EQ(low.overruns(), 1U);
}

/// @brief A stopped timer raises no interrupt. The flag of an interrupt stays set until it is
/// acknowledged.
TEST_F(HostSchedulerTest, TimerRaisesItsInterruptWhileItRuns) {
  host::HostTimer timer(scheduler);
  int pulses = 0;
  timer.connect([&] { ++pulses; });
  timer.periodPassed();
  EXPECT_EQ(pulses, 0);
  timer.start(milliseconds(100));
  timer.periodPassed();
  EXPECT_EQ(pulses, 1);
  EXPECT_TRUE(timer.pending());
  timer.acknowledge();
  EXPECT_FALSE(timer.pending());
  timer.stop();
  timer.periodPassed();
  EXPECT_EQ(pulses, 1);
}

/// @brief If a watchdog is not refreshed in time, missed() returns true. This is also true after a
/// later refresh.
TEST(HostWatchdogTest, ALaterRefreshKeepsTheMiss) {
  host::HostTimebase time;
  host::HostWatchdog watchdog(time);
  const Microseconds timeout = SystemConstants::instance().watchdogTimeout();
  time.advance(timeout - Microseconds(1));
  EXPECT_FALSE(watchdog.missed());
  watchdog.refresh();
  time.advance(timeout);
  EXPECT_TRUE(watchdog.missed());
  watchdog.refresh();
  EXPECT_TRUE(watchdog.missed());
  EXPECT_EQ(watchdog.refreshes(), 2U);
}

/// @brief The time of a HostTimebase begins at 0, and passes only when advance() is called.
TEST(HostTimebaseTest, SteppedTimePassesByHand) {
  host::HostTimebase time;
  EXPECT_EQ(time.now(), Instant(0));
  time.advance(milliseconds(3));
  EXPECT_EQ(time.now(), Instant(3000));
}

// Returns all bytes that a port has received.
scenario::Bytes readAll(SerialPort& port) {
  scenario::Bytes all;
  scenario::Bytes read(4096);
  for (std::size_t count = port.read(read); count != 0; count = port.read(read)) {
    all.insert(all.end(), read.begin(), read.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return all;
}

/// @brief Received bytes are read in their order. Bytes for which there is no space are counted as
/// lost.
TEST(HostSerialPortTest, ReceivesUpToItsCapacity) {
  host::HostSerialPort port;
  port.arrive(counting(host::HostSerialPort::kReceived + 3));
  EXPECT_EQ(port.lostBytes(), 3);
  EXPECT_EQ(readAll(port), counting(host::HostSerialPort::kReceived));
}

/// @brief A read ends with a zero byte. The port returns the time of this byte.
/// @verifies FR-20
TEST(HostSerialPortTest, ReadEndsWithAZeroByte) {
  host::HostTimebase time;
  host::HostSerialPort port;
  port.setClock(time);
  time.advance(milliseconds(5));
  port.arrive(scenario::Bytes{1, 2, 0, 3});
  time.advance(milliseconds(2));
  port.arrive(scenario::Bytes{0, 4});
  scenario::Bytes read(8);
  EXPECT_EQ(port.read(read), 3U);
  EXPECT_EQ(port.receivedAt(), Instant(5000));
  EXPECT_EQ(port.read(read), 2U);
  EXPECT_EQ(port.receivedAt(), Instant(7000));
  EXPECT_EQ(port.read(read), 1U);
  EXPECT_EQ(port.read(read), 0U);
}

/// @brief A write is accepted only as a whole.
TEST(HostSerialPortTest, WritesAllOrNothing) {
  host::HostSerialPort port;
  EXPECT_TRUE(port.write(counting(host::HostSerialPort::kSent - 2)));
  EXPECT_EQ(port.free(), 2U);
  EXPECT_FALSE(port.write(counting(3)));
  EXPECT_EQ(port.takeSent(), counting(host::HostSerialPort::kSent - 2));
  EXPECT_TRUE(port.write(counting(3)));
}

}  // namespace
}  // namespace wr::test
