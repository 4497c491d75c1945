#pragma once

#include <chrono>
#include <cstdio>
#include <functional>

namespace wr::programs {

/// @brief Keeps the time of a simulated robot with the clock of the machine.
///
/// When the machine is late by more than kLate, the robot's time stands still instead of running
/// after the clock: its PC gets no burst of cycles.
class Pace final {
 public:
  using Clock = std::chrono::steady_clock;

  /// @brief Lateness that is made up for.
  static constexpr Clock::duration kLate = std::chrono::milliseconds(20);

  /// @brief Begins at time 0 of the robot.
  /// @param now clock of the machine
  /// @param sleepUntil sleeps until a time of this clock
  explicit Pace(std::function<Clock::time_point()> now = &Clock::now,
                std::function<void(Clock::time_point)> sleepUntil = &Pace::sleep);

  /// @brief Waits for a time of the robot.
  /// @param time since the start of the robot
  void waitFor(Clock::duration time);

  /// @brief Returns for how long the robot's time stood still.
  [[nodiscard]] Clock::duration lost() const { return lost_; }

 private:
  static void sleep(Clock::time_point until);

  std::function<Clock::time_point()> now_;
  std::function<void(Clock::time_point)> sleepUntil_;
  Clock::time_point start_;
  Clock::duration lost_{};
};

/// @brief Prints for how long the robot's time stood still, if it did.
/// @param pace of the run that ended
/// @param output where to print
void printLost(const Pace& pace, std::FILE* output);

}  // namespace wr::programs
