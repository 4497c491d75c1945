#pragma once

#include <chrono>
#include <cstdio>
#include <functional>

namespace wr::programs {

/// @brief Synchronises the time of a simulated robot with the clock of the machine.
///
/// When the machine is late by more than kLate, the robot's time stands still instead of catching
/// up, so that its PC gets no burst of cycles.
class Pace final {
 public:
  using Clock = std::chrono::steady_clock;

  /// @brief Greatest delay that is compensated.
  static constexpr Clock::duration kLate = std::chrono::milliseconds(20);

  /// @brief Begins at time 0 of the robot.
  /// @param now clock of the machine
  /// @param sleepUntil sleeps until a time of this clock
  explicit Pace(std::function<Clock::time_point()> now = &Clock::now,
                std::function<void(Clock::time_point)> sleepUntil = &Pace::sleep);

  /// @brief Waits for a time of the robot.
  /// @param time since the start of the robot
  void waitFor(Clock::duration time);

  /// @brief Returns the duration in which the simulated time did not advance.
  [[nodiscard]] Clock::duration lost() const { return lost_; }

 private:
  static void sleep(Clock::time_point until);

  std::function<Clock::time_point()> now_;
  std::function<void(Clock::time_point)> sleepUntil_;
  Clock::time_point start_;
  Clock::duration lost_{};
};

/// @brief Prints the duration in which the simulated time did not advance. Prints nothing for 0.
/// @param pace pace of the ended run
/// @param output receives the text
void printLost(const Pace& pace, std::FILE* output);

}  // namespace wr::programs
