#pragma once

#include <chrono>
#include <cstdio>
#include <functional>

namespace wr::programs {

/// @brief The synchronisation of the time of a simulated robot with the clock of the computer.
///
/// When the computer is late by more than kLate, the time of the robot does not catch up with the
/// clock. If it did, the PC would get the reports of many cycles at once.
class Pace final {
 public:
  using Clock = std::chrono::steady_clock;

  /// @brief Greatest delay that is compensated.
  static constexpr Clock::duration kLate = std::chrono::milliseconds(20);

  /// @brief Starts the synchronisation at time 0 of the robot.
  /// @param now returns the time of the computer's clock
  /// @param sleepUntil sleeps until a time of the computer's clock
  explicit Pace(std::function<Clock::time_point()> now = &Clock::now,
                std::function<void(Clock::time_point)> sleepUntil = &Pace::sleep);

  /// @brief Waits for a time of the robot.
  /// @param time time since the start of the robot
  void waitFor(Clock::duration time);

  /// @brief Returns the sum of all delays that were greater than kLate.
  [[nodiscard]] Clock::duration lost() const { return lost_; }

 private:
  static void sleep(Clock::time_point until);

  std::function<Clock::time_point()> now_;
  std::function<void(Clock::time_point)> sleepUntil_;
  Clock::time_point start_;
  Clock::duration lost_{};
};

/// @brief Prints the sum of all delays that were not compensated. Prints nothing if the sum is 0.
/// @param pace pace of the run that has ended
/// @param output receives the text
void printLost(const Pace& pace, std::FILE* output);

}  // namespace wr::programs
