#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>

#include "support/seed.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {

inline constexpr int kN = 4;
inline constexpr std::int64_t kPeriod = 100'000;
inline constexpr std::int64_t kLifetime = 200'000;

/// The required behaviour of the robot. This class was written from the requirements, without the
/// firmware's code. Times are in microseconds.
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

/// A source of orders that alternates between active and silent. Each phase has a random duration.
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

/// Runs the robot and its reference in parallel, and compares the reports that both send to the PC.
class Comparison {
 public:
  Comparison(SteppedRobot& robot, std::mt19937& random) : robot_(robot), random_(random) {}
  Comparison(const Comparison&) = delete;
  Comparison& operator=(const Comparison&) = delete;
  virtual ~Comparison() = default;

  /// Runs one sequence. The robot and its reference continue from the end of the previous sequence.
  void sequence() {
    beginSequence();
    Runs pc(oneIn(2), 5, 12);
    const int length = number(5, 14);
    for (int i = 0; i < length && !testing::Test::HasFatalFailure(); ++i) {
      oneCycle(pc.next(random_));
    }
  }

  std::map<std::string, int> taken;
  int cycles = 0;

 protected:
  /// If a target has other inputs besides the serial line of the PC, a subclass for this target
  /// overrides these functions.
  virtual void beginSequence() {}
  virtual void beforeCycle() {}
  virtual void compareInside() {}

  int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool oneIn(int count) { return number(1, count) == 1; }
  std::mt19937& random() { return random_; }
  Reference& reference() { return reference_; }

  /// Returns the time of the last clock pulse.
  [[nodiscard]] std::int64_t lastPulse() const { return cycles * kPeriod; }

 private:
  void pcSpeaks(std::int64_t receivedAt) {
    const int id = number(1, 65535);
    const bool stop = oneIn(20);
    robot_.order({.id = static_cast<std::uint16_t>(id), .stop = stop});
    reference_.stop = reference_.stop || stop;
    if (reference_.connected) {
      reference_.acceptOrder(id, stop, receivedAt);
    }
  }

  void oneCycle(bool pc) {
    const std::int64_t pulse = lastPulse() + kPeriod;
    beforeCycle();
    if (!reference_.connected && robot_.welcome && helloSent_) {
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
      pcSpeaks(lastPulse());
    }
    const int stateBefore = reference_.state;
    const int modeBefore = reference_.mode;
    robot_.cycle();
    reference_.cycle(pulse);
    ++cycles;
    compareInside();
    compare();
    note(stateBefore, modeBefore);
  }

  void compare() {
    ASSERT_EQ(robot_.reported(), reference_.connected) << cycles;
    if (!robot_.reported()) {
      return;
    }
    const scenario::PcReport& report = robot_.report();
    ASSERT_EQ(report.state, reference_.state) << cycles;
    ASSERT_EQ(report.mode, reference_.mode) << cycles;
    ASSERT_EQ(report.orderRead(), reference_.orderRead) << cycles;
    ASSERT_EQ(report.source, reference_.source) << cycles;
    ASSERT_EQ(report.orderId, reference_.orderId) << cycles;
    ASSERT_EQ(report.stop(), reference_.stop) << cycles;
    ASSERT_EQ(report.held(), reference_.held || report.inhibit == kNotArmed) << cycles;
  }

  // Counts the observed behaviour of the robot. Cycles without a report are not counted.
  void note(int stateBefore, int modeBefore) {
    static const std::array<std::string, 4> names{"Working", "Waiting", "WaitingN", "Reconnecting"};
    if (robot_.reported()) {
      const scenario::PcReport& report = robot_.report();
      ++taken[names.at(static_cast<std::size_t>(stateBefore)) + "->" + names.at(report.state)];
      if (report.mode != modeBefore) {
        ++taken[modeBefore == kRc ? "RC->PC" : "PC->RC"];
      }
    }
  }

  SteppedRobot& robot_;
  std::mt19937& random_;
  Reference reference_;
  bool helloSent_ = false;
};

/// A robot, and its comparison with the reference.
template <class Robot, class ComparisonOfRobot>
struct Compared {
  explicit Compared(std::mt19937& random) : comparison(robot, random) {}
  Robot robot;
  ComparisonOfRobot comparison;
};

/// Runs random sequences. Each robot runs at most a hundred sequences. Checks that each transition
/// of the operation states and of the reading modes has occurred at least the given number of
/// times.
template <class Robot, class ComparisonOfRobot>
void compareInSequences(int sequences, int enough) {
  const unsigned seedOfRun = seed();
  std::mt19937 random(seedOfRun);
  std::map<std::string, int> taken;
  int cycles = 0;
  for (int first = 0; first < sequences; first += 100) {
    Compared<Robot, ComparisonOfRobot> run(random);
    for (int sequence = first; sequence < std::min(first + 100, sequences); ++sequence) {
      run.comparison.sequence();
      ASSERT_FALSE(testing::Test::HasFatalFailure())
          << "seed " << seedOfRun << ", sequence " << sequence;
    }
    cycles += run.comparison.cycles;
    for (const auto& [transition, count] : run.comparison.taken) {
      taken[transition] += count;
    }
  }
  std::cout << cycles << " cycles\n";
  for (const auto& [transition, count] : taken) {
    std::cout << transition << " " << count << "\n";
    testing::Test::RecordProperty(transition, count);
  }
  for (const char* transition :
       {"Working->Working", "Working->Waiting", "Waiting->Waiting", "Waiting->Working",
        "Waiting->WaitingN", "WaitingN->Working", "WaitingN->Reconnecting", "Reconnecting->Working",
        "Reconnecting->Reconnecting", "RC->PC", "PC->RC"}) {
    EXPECT_GE(taken[transition], enough) << transition;
  }
  EXPECT_EQ(taken.size(), 11U) << "there was a transition that no state machine declares";
}

}  // namespace wr::test
