#pragma once

#include <deque>
#include <functional>

#include "sim/emulator/Clock.hpp"

namespace wr::emulator {

/// @brief Inputs of the board from its surroundings, each with its time.
class StimulusQueue {
 public:
  /// @brief A level that is put on a pin at a time.
  struct Level {
    Time at;
    char port;
    unsigned pin;
    bool high;
  };

  /// @brief Sets the function that puts a level on a pin.
  explicit StimulusQueue(std::function<void(const Level&)> drive) : drive_(std::move(drive)) {}

  /// @brief Adds a level. Levels of the same time are applied in the order in which they were
  /// added.
  void add(const Level& level);

  /// @brief Adds a call at each multiple of a period after a time.
  void every(Time period, Time now, std::function<void()> call);

  /// @brief Returns the time of the next stimulus; kNever when there is no stimulus.
  [[nodiscard]] Time next() const { return next_; }

  /// @brief Runs all stimuli up to a time, in order. At equal times, levels come before calls.
  void advance(Time now);

 private:
  struct Call {
    Time period;
    Time at;
    std::function<void()> call;
  };

  [[nodiscard]] Call* firstCall();
  void renew();

  std::function<void(const Level&)> drive_;
  std::deque<Level> levels_;
  std::deque<Call> calls_;  // a call may add calls; the existing calls do not move
  Time next_ = kNever;
};

}  // namespace wr::emulator
