#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "services/Command.hpp"
#include "sim/host/HostScheduler.hpp"
#include "sim/host/HostSerialPort.hpp"
#include "sim/host/HostThread.hpp"
#include "sim/host/HostTimebase.hpp"
#include "sim/host/HostTimer.hpp"
#include "sim/host/PtySerialPort.hpp"
#include "sim/scenario/PcFrames.hpp"

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
  HostScheduler scheduler;
  HostThread low{scheduler, 1};
  HostThread high{scheduler, 2};
  HostThread alsoHigh{scheduler, 2};
};

/// @brief A thread of higher priority runs before the post that pends it returns.
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

/// @brief Threads of equal or lower priority run when the running one has ended, the higher first.
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

/// @brief A thread that an interrupt posts runs after the interrupt.
TEST_F(HostSchedulerTest, ThreadRunsAfterTheInterrupt) {
  Body highBody([&] { log.emplace_back("high"); });
  high.start(highBody);
  scheduler.interrupt([&] {
    high.post();
    log.emplace_back("interrupt ends");
  });
  EXPECT_EQ(log, (Log{"interrupt ends", "high"}));
}

/// @brief A thread that posts itself runs once more, not nested.
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
  EXPECT_EQ(low.overruns(), 1);
}

/// @brief A timer that is stopped raises no interrupt; the flag of a raised one stays until acknowledged.
TEST_F(HostSchedulerTest, TimerRaisesItsInterruptWhileItRuns) {
  HostTimer timer(scheduler);
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

/// @brief Stepped time passes only when it is advanced.
TEST(HostTimebaseTest, SteppedTimePassesByHand) {
  HostTimebase time;
  EXPECT_EQ(time.now(), Instant(0));
  time.advance(milliseconds(3));
  EXPECT_EQ(time.now(), Instant(3000));
}

/// @brief Real time runs from its construction, and a sleep ends no earlier than its instant.
TEST(HostTimebaseTest, RealTimeRuns) {
  const RealTimebase time;
  const Instant wake = time.now() + milliseconds(5);
  EXPECT_LT(time.now(), Instant(5'000'000));
  time.sleepUntil(wake);
  EXPECT_GE(time.now(), wake);
}

Bytes counting(std::size_t count) {
  Bytes bytes(count);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return bytes;
}

// All bytes that a port has received.
Bytes readAll(SerialPort& port) {
  Bytes all;
  Bytes read(4096);
  for (std::size_t count = port.read(read); count != 0; count = port.read(read)) {
    all.insert(all.end(), read.begin(), read.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return all;
}

/// @brief Received bytes are read in their order; what finds no room is counted as lost.
TEST(HostSerialPortTest, ReceivesUpToItsCapacity) {
  HostSerialPort port;
  port.arrive(counting(HostSerialPort::kReceived + 3));
  EXPECT_EQ(port.lostBytes(), 3);
  EXPECT_EQ(readAll(port), counting(HostSerialPort::kReceived));
}

/// @brief A read ends with a zero byte, and the port says when that byte came.
/// @verifies FR-20
TEST(HostSerialPortTest, ReadEndsWithAZeroByte) {
  HostTimebase time;
  HostSerialPort port;
  port.setClock(time);
  time.advance(milliseconds(5));
  port.arrive(Bytes{1, 2, 0, 3});
  time.advance(milliseconds(2));
  port.arrive(Bytes{0, 4});
  Bytes read(8);
  EXPECT_EQ(port.read(read), 3U);
  EXPECT_EQ(port.receivedAt(), Instant(5000));
  EXPECT_EQ(port.read(read), 2U);
  EXPECT_EQ(port.receivedAt(), Instant(7000));
  EXPECT_EQ(port.read(read), 1U);
  EXPECT_EQ(port.read(read), 0U);
}

/// @brief A write is taken whole or not at all.
TEST(HostSerialPortTest, WritesAllOrNothing) {
  HostSerialPort port;
  EXPECT_TRUE(port.write(counting(HostSerialPort::kSent - 2)));
  EXPECT_EQ(port.free(), 2U);
  EXPECT_FALSE(port.write(counting(3)));
  EXPECT_EQ(port.takeSent(), counting(HostSerialPort::kSent - 2));
  EXPECT_TRUE(port.write(counting(3)));
}

class Client {
 public:
  explicit Client(const std::string& path) : file_(open(path.c_str(), O_RDWR | O_NOCTTY)) {}
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client() { close(file_); }

  void send(const Bytes& bytes) const {
    EXPECT_EQ(::write(file_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  [[nodiscard]] Bytes receive(std::size_t count) const {
    Bytes bytes(count);
    const ssize_t got = ::read(file_, bytes.data(), bytes.size());
    bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return bytes;
  }

 private:
  int file_;
};

/// @brief All 256 byte values pass the pseudo-terminal unchanged in both directions.
TEST(PtySerialPortTest, PassesEveryByteValue) {
  PtySerialPort port;
  const Client client(port.path());
  client.send(counting(256));
  EXPECT_EQ(readAll(port), counting(256));
  EXPECT_TRUE(port.write(counting(256)));
  EXPECT_EQ(client.receive(300), counting(256));
}

/// @brief A client may leave and another may come.
TEST(PtySerialPortTest, SurvivesAClientThatLeaves) {
  PtySerialPort port;
  Bytes read(8);
  for (int i = 0; i < 3; ++i) {
    const Client client(port.path());
    client.send({1, 2, 3});
    EXPECT_EQ(port.read(read), 3U);
    EXPECT_TRUE(port.write(counting(4)));
    EXPECT_EQ(client.receive(8), counting(4));
  }
  EXPECT_EQ(port.read(read), 0U);
  EXPECT_EQ(port.lostBytes(), 0);
}

/// @brief When nobody reads, the port fills; then a write is refused whole and nothing blocks.
TEST(PtySerialPortTest, RefusesWhatHasNoRoom) {
  PtySerialPort port;
  int written = 0;
  while (port.write(counting(100)) && written < 10'000) {
    ++written;
  }
  EXPECT_LT(written, 10'000);
  EXPECT_LT(port.free(), 100U);
  const Client client(port.path());
  EXPECT_EQ(client.receive(100), counting(100));
}

}  // namespace
}  // namespace wr::test
