#pragma once

#include <cstdint>

#include "units/quantities.hpp"

namespace wr {

/// @brief Source of the time since the start of the system.
/// @function Returns the time since start, for time stamps and time-outs. Returns the number of
/// processor cycles without sleep. The computing time of a control cycle is calculated from this
/// number.
/// @secret The counters that measure the time and the processor cycles, and the method by which an
/// overflow of the time is prevented.
class Timebase {
 public:
  Timebase(const Timebase&) = delete;
  Timebase& operator=(const Timebase&) = delete;

  /// @brief Returns the present time.
  /// @return time since start [us]; never less than the result of the previous call
  /// @isr{yes}
  /// @satisfies FR-127
  [[nodiscard]] virtual Instant now() const = 0;

  /// @brief Returns the number of processor cycles in which the processor did not sleep.
  /// @return number of cycles since start. The number begins again at 0 after 2^32 cycles, and is
  /// always 0 on a platform that does not count cycles
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
