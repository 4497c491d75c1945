#pragma once

#include <cstdint>
#include <optional>

#include "units/quantities.hpp"

namespace wr {

/// @brief A detector of interrupts that the processor does not serve.
///
/// @function Measures the time between ticks, and counts the successive ticks at which a Hall edge
/// waits for its interrupt. Ends the program with an assertion if a tick is late, or if an edge
/// waits for too many ticks. The assertion resets the microcontroller. The start after this reset
/// sets up every device again.
///
/// @secret The permitted delay of an interrupt.
class InterruptWatch final {
 public:
  /// @brief Constructs a detector that has received no tick yet.
  constexpr InterruptWatch() = default;
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

  /// @brief Checks the interrupts of the ticks and of the Hall edges. The handler of each tick
  /// calls this function.
  /// @param now time of the tick
  /// @param edgeWaits true if a Hall edge is not acknowledged yet, although its interrupt has a
  /// higher priority than the tick
  /// @errors The program ends with the assertion InterruptLate in two cases: this tick occurs more
  /// than 20 ms after the previous tick, or a Hall edge has waited at 5 successive ticks.
  /// @satisfies FR-308
  /// @isr{yes}
  void tick(Instant now, bool edgeWaits);

 private:
  std::optional<Instant> before_;  // time of the previous tick
  std::uint8_t waitingTicks_ = 0;  // number of successive ticks with a waiting edge
};

}  // namespace wr
