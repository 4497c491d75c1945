#pragma once

#include <cstdint>

#include "devices/PeriodicTimer.hpp"
#include "ports/mps2/registers.hpp"

namespace wr::mps2 {

/// @brief One of the two timers of the board.
class CmsdkTimer final : public PeriodicTimer {
 public:
  /// @brief Number of a timer.
  enum class Number : std::uint8_t { First = 0, Second = 1 };

  /// @param number number of the timer
  explicit constexpr CmsdkTimer(Number number)
      : offset_(static_cast<std::uint32_t>(number) * timer::kDistance) {}

  void start(Microseconds period) override {
    stop();
    const auto ticks = static_cast<std::uint32_t>(period.count()) * kTicksPerMicrosecond;
    timer::RELOAD.at(offset_).write({ticks - 1});
    timer::CTRL.at(offset_).write(timer::CTRL_ENABLE | timer::CTRL_INTERRUPT);
  }
  void stop() override { timer::CTRL.at(offset_).write({0}); }
  void acknowledge() override { timer::INTCLEAR.at(offset_).write({1}); }

 private:
  std::uint32_t offset_;
};

}  // namespace wr::mps2
