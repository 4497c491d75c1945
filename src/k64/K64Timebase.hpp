#pragma once

#include <cstdint>

#include "devices/Timebase.hpp"

namespace wr {

/// @brief The time since start, from channel 2 of the periodic interrupt timer.
/// @function Tells the time in microseconds to threads and interrupts.
/// @secret How a counter of 32 bits that runs down gives a time that never wraps.
class K64Timebase final : public Timebase {
 public:
  /// @brief Makes a clock that does not run yet.
  constexpr K64Timebase() = default;

  /// @brief Starts the clock at 0.
  /// @pre The clocks of the timers run.
  /// @isr{no}
  void start();

  /// @pre Two calls are less than 71 s apart.
  /// @isr{yes}
  [[nodiscard]] Instant now() const override;

 private:
  mutable std::uint32_t wraps_ = 0;  // periods of the counter that have passed
};

}  // namespace wr
