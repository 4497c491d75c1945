#pragma once

#include <deque>
#include <functional>

#include "sim/emulator/Clock.hpp"

namespace wr::emulator {

/// @brief The stimuli of the board, which are inputs from outside. Each stimulus has a time.
class StimulusQueue {
 public:
  /// @brief A level on a pin, and the time at which the pin gets this level.
  struct Level {
    Time at;
    char port;
    unsigned pin;
    bool high;
  };

  /// @param drive function that puts a level on a pin
  explicit StimulusQueue(std::function<void(const Level&)> drive) : drive_(std::move(drive)) {}

  /// @brief Adds a level. Levels with the same time are applied in the order of the calls of add().
  void add(const Level& level);

  /// @brief Adds a function. The function is called at each future time that is a multiple of the
  /// period.
  void every(Time period, Time now, std::function<void()> call);

  /// @brief Returns the time of the next stimulus; kNever when there is no stimulus.
  [[nodiscard]] Time next() const { return next_; }

  /// @brief Applies all stimuli up to a time, in the order of their times. At equal times, levels
  /// are applied before functions are called.
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
  // A called function may add functions. When elements are added to a deque, the other elements do
  // not move.
  std::deque<Call> calls_;
  Time next_ = kNever;
};

}  // namespace wr::emulator
