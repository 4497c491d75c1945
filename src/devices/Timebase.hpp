#pragma once

#include <cstdint>

#include "units/quantities.hpp"

namespace wr {

/// @brief Clock that runs from the start of the system.
/// @function Returns the time for time stamps and time-outs, and the time in which the processor
/// was awake, for the cost of a cycle.
/// @secret Which counters measure the time and the work, and how an overflow of the time is
/// prevented.
class Timebase {
 public:
  Timebase(const Timebase&) = delete;
  Timebase& operator=(const Timebase&) = delete;

  /// @brief Returns the time.
  /// @return time since start [us]; never less than at the previous call
  /// @isr{yes}
  /// @satisfies FR-127
  [[nodiscard]] virtual Instant now() const = 0;

  /// @brief Counts the cycles of the processor in which it does not sleep.
  /// @return number of cycles since start; it begins again at 0 after 2^32 cycles; always 0 if the
  /// platform does not count cycles
  /// @satisfies FR-160
  /// @satisfies FR-302
  /// @satisfies FR-303
  /// @satisfies FR-304
  /// @isr{yes}
  [[nodiscard]] virtual std::uint32_t awakeCycles() const = 0;

 protected:
  Timebase() = default;
  ~Timebase() = default;
};

}  // namespace wr
