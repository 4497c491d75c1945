#pragma once

#include "units/quantities.hpp"

namespace wr {

/// @brief Clock that runs from the start of the system.
/// @function Tells the time to who must stamp values or wait for a time-out.
/// @secret Which counter measures the time, and how it is kept from wrapping.
class Timebase {
 public:
  Timebase(const Timebase&) = delete;
  Timebase& operator=(const Timebase&) = delete;

  /// @brief Tells the time.
  /// @return time since start [us]; never less than at the call before
  /// @isr{yes}
  /// @satisfies FR-127
  [[nodiscard]] virtual Instant now() const = 0;

 protected:
  Timebase() = default;
  ~Timebase() = default;
};

}  // namespace wr
