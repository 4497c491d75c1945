#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>

#include "system/SteppedRobot.hpp"

namespace wr::test {
namespace {

constexpr int kN = 4;
constexpr std::int64_t kPeriod = 100'000;
constexpr std::int64_t kLifetime = 200'000;
constexpr int kSequences = 10'000;
constexpr int kSequencesOfOneRobot = 100;
constexpr int kEnough = 100;

// What the robot must do, written from the requirements and without the firmware's code. Times are
// in microseconds.
struct Reference {
  int state = kWorking;
  int failedReads = 0;
  int mode = kRc;
  int source = kNobody;
  int orderId = 0;
  bool orderRead = false;
  bool held = true;

  bool connected = false;
  bool stop = false;
  std::optional<int> pcOrder;  // id of the newest order that was not read
  std::int64_t pcOrderAt = 0;
  std::optional<std::int64_t> velocityAt;
  std::optional<std::int64_t> directionAt;

  void acceptOrder(int id, bool withStop, std::int64_t now) {
    pcOrder = id;
    pcOrderAt = now;
    stop = withStop;
  }

  void endConnection() {
    connected = false;
    pcOrder.reset();
  }

  [[nodiscard]] bool rcHasMessage(std::int64_t now) const {
    return velocityAt && directionAt && now - *velocityAt <= kLifetime &&
           now - *directionAt <= kLifetime;
  }

  [[nodiscard]] bool pcHasMessage(std::int64_t now) const {
    return connected && pcOrder && now - pcOrderAt <= kLifetime;
  }

  void cycle(std::int64_t now) {
    orderRead = mode == kRc ? rcHasMessage(now) : pcHasMessage(now);
    if (orderRead) {
      source = mode;
      if (mode == kRc) {
        orderId = 0;
        velocityAt.reset();
        directionAt.reset();
      } else {
        orderId = *pcOrder;
        pcOrder.reset();
      }
      state = kWorking;
      failedReads = 0;
    } else {
      if (state == kReconnecting) {
        mode = mode == kRc ? kPc : kRc;
      }
      ++failedReads;
      if (failedReads < kN) {
        state = kWaiting;
      } else if (failedReads == kN) {
        state = kWaitingN;
      } else {
        state = kReconnecting;
      }
    }
    held = stop || source == kNobody || state == kReconnecting;
  }
};

// A source that speaks and is silent in runs of random length.
class Runs {
 public:
  Runs(bool speaks, int longestSpeech, int longestSilence)
      : longestSpeech_(longestSpeech), longestSilence_(longestSilence), speaks_(speaks) {}

  bool next(std::mt19937& random) {
    if (left_ == 0) {
      speaks_ = !speaks_;
      left_ =
          std::uniform_int_distribution<int>(1, speaks_ ? longestSpeech_ : longestSilence_)(random);
    }
    --left_;
    return speaks_;
  }

 private:
  int longestSpeech_;
  int longestSilence_;
  bool speaks_;
  int left_ = 0;
};

class Comparison {
 public:
  explicit Comparison(std::mt19937& random) : random_(random) {}

  // Runs one sequence; the robot and its reference go on from where the last sequence left them.
  void sequence() {
    Runs rc(oneIn(2), 5, 12);
    Runs pc(oneIn(2), 5, 12);
    const int length = number(5, 14);
    for (int i = 0; i < length && !testing::Test::HasFatalFailure(); ++i) {
      oneCycle(rc.next(random_), pc.next(random_));
    }
  }

  std::map<std::string, int> taken;
  int cycles = 0;

 private:
  int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool oneIn(int count) { return number(1, count) == 1; }

  [[nodiscard]] std::int64_t now() const {
    return static_cast<std::int64_t>(robot_.time.now().sinceStart());
  }

  void rcSpeaks() {
    robot_.wait(Microseconds(number(1, kPeriod - 1)));
    if (!oneIn(8)) {
      robot_.robot.rcVelocity(Velocity(number(-3000, 3000)));
      reference_.velocityAt = now();
    }
    if (!oneIn(8)) {
      robot_.robot.rcDirection(Angle(number(-3200, 3200)));
      reference_.directionAt = now();
    }
  }

  void pcSpeaks(std::int64_t pulse) {
    const int id = number(1, 65535);
    const bool stop = oneIn(20);
    robot_.order({.id = static_cast<std::uint16_t>(id), .stop = stop});
    if (reference_.connected) {
      reference_.acceptOrder(id, stop, pulse);
    }
  }

  void oneCycle(bool rc, bool pc) {
    const std::int64_t pulse = now() + kPeriod;
    if (rc) {
      rcSpeaks();
    }
    if (!reference_.connected && robot_.session && helloSent_) {
      robot_.confirm();
      helloSent_ = false;
      reference_.connected = true;
    } else if (!reference_.connected || oneIn(200)) {
      robot_.hello();
      helloSent_ = true;
      reference_.endConnection();
    } else if (!pc) {
      robot_.keepAlive();
    }
    if (pc) {
      pcSpeaks(pulse);
    }
    const int stateBefore = reference_.state;
    const int modeBefore = reference_.mode;
    robot_.cycle();
    reference_.cycle(pulse);
    ++cycles;
    compare();
    note(stateBefore, modeBefore);
  }

  void compare() {
    const ControlData& data = robot_.robot.controller().getData();
    ASSERT_EQ(robot_.reported(), reference_.connected) << cycles;
    ASSERT_EQ(static_cast<int>(robot_.robot.controller().getMode().id()), reference_.mode)
        << cycles;
    ASSERT_EQ(data.stopped(), reference_.stop) << cycles;
    ASSERT_EQ(robot_.system.calls, reference_.held ? kHeld : kControlled) << cycles;
    if (!robot_.reported()) {
      return;
    }
    const PcReport& report = robot_.report();
    ASSERT_EQ(report.state, reference_.state) << cycles;
    ASSERT_EQ(report.mode, reference_.mode) << cycles;
    ASSERT_EQ(report.orderRead(), reference_.orderRead) << cycles;
    ASSERT_EQ(report.source, reference_.source) << cycles;
    ASSERT_EQ(report.orderId, reference_.orderId) << cycles;
    ASSERT_EQ(report.held(), reference_.held) << cycles;
  }

  // Counts what the robot was seen to do; cycles without report do not count.
  void note(int stateBefore, int modeBefore) {
    static const std::array<std::string, 4> names{"Working", "Waiting", "WaitingN", "Reconnecting"};
    if (robot_.reported()) {
      const PcReport& report = robot_.report();
      ++taken[names.at(static_cast<std::size_t>(stateBefore)) + "->" + names.at(report.state)];
      if (report.mode != modeBefore) {
        ++taken[modeBefore == kRc ? "RC->PC" : "PC->RC"];
      }
    }
  }

  std::mt19937& random_;
  SteppedRobot robot_;
  Reference reference_;
  bool helloSent_ = false;
};

std::uint32_t seedOfRun() {
  const char* given = std::getenv("WR_SEED");
  return given != nullptr ? static_cast<std::uint32_t>(std::strtoul(given, nullptr, 10))
                          : std::random_device{}();
}

/// @brief In 10000 random sequences of orders from both sources the robot does in every cycle what a
/// reference written from the requirements does, and takes each transition of both machines often.
/// @verifies FR-10
/// @verifies FR-11
/// @verifies FR-12
/// @verifies FR-13
/// @verifies FR-15
/// @verifies FR-16
/// @verifies FR-17
/// @verifies FR-18
/// @verifies FR-19
/// @verifies FR-20
TEST(OperationStatesReference, RobotDoesWhatTheReferenceDoes) {
  const std::uint32_t seed = seedOfRun();
  std::cout << "seed " << seed << "\n";
  RecordProperty("seed", std::to_string(seed));
  std::mt19937 random(seed);
  std::map<std::string, int> taken;
  int cycles = 0;
  std::unique_ptr<Comparison> comparison;
  for (int sequence = 0; sequence < kSequences; ++sequence) {
    if (sequence % kSequencesOfOneRobot == 0) {
      comparison = std::make_unique<Comparison>(random);
    }
    comparison->sequence();
    ASSERT_FALSE(HasFatalFailure()) << "seed " << seed << ", sequence " << sequence;
    if ((sequence + 1) % kSequencesOfOneRobot == 0) {
      cycles += comparison->cycles;
      for (const auto& [transition, count] : comparison->taken) {
        taken[transition] += count;
      }
    }
  }
  std::cout << cycles << " cycles\n";
  for (const auto& [transition, count] : taken) {
    std::cout << transition << " " << count << "\n";
    RecordProperty(transition, count);
  }
  for (const char* transition :
       {"Working->Working", "Working->Waiting", "Waiting->Waiting", "Waiting->Working",
        "Waiting->WaitingN", "WaitingN->Working", "WaitingN->Reconnecting", "Reconnecting->Working",
        "Reconnecting->Reconnecting", "RC->PC", "PC->RC"}) {
    EXPECT_GE(taken[transition], kEnough) << transition;
  }
  EXPECT_EQ(taken.size(), 11U) << "a transition that no state machine declares";
}

}  // namespace
}  // namespace wr::test
