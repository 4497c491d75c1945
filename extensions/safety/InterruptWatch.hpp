#pragma once

#include <cstdint>
#include <optional>

#include "units/quantities.hpp"

namespace wr {

/// @brief Finds interrupts that the processor does not serve.
///
/// @function Measures the time between ticks, and counts the successive ticks at which a Hall edge
/// waits for its interrupt. Ends the program when a tick or an edge is late. After the reset every
/// device is set up again.
///
/// @secret How late an interrupt may be.
class InterruptWatch final {
 public:
  /// @brief Begins without a tick.
  constexpr InterruptWatch() = default;
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  /// @brief Checks the interrupts. Each tick calls this function.
  /// @param now time of the tick
  /// @param edgeWaits whether a Hall edge is not acknowledged yet; its interrupt has the higher priority
  /// @errors A tick more than 20 ms after the previous tick, and an edge that waits at 5 successive
  /// ticks, end the program with the assertion InterruptLate.
  /// @satisfies FR-308
  /// @isr{yes}
  void tick(Instant now, bool edgeWaits);

 private:
  std::optional<Instant> before_;  // time of the previous tick
  std::uint8_t waitingTicks_ = 0;  // successive ticks with an edge that waits
};

}  // namespace wr
