#pragma once

#include <cstdint>

#include "devices/Timebase.hpp"
#include "k64/K64Board.hpp"

namespace wr {

/// @brief The time since start, from channel 2 of the periodic interrupt timer, and the cycles of
/// the core, from the cycle counter of the core.
/// @function Returns the time in microseconds to threads and interrupts. Lets the core sleep, and
/// returns the number of cycles in which it was awake.
/// @secret How the time is computed from a 32-bit down counter, without overflow and without a
/// 64-bit division. How the cycles are counted, even if the counter of the core stops during sleep.
class K64Timebase final : public Timebase {
 public:
  /// @brief One time for all signals that an interrupt serves. Its handler records the time at its
  /// entry, so that its work for one signal does not delay the time of the next signal.
  class EntryTime final : public Timebase {
   public:
    /// @brief Binds the time to its clock.
    /// @param clock the clock; it exists as long as this object
    explicit constexpr EntryTime(const K64Timebase& clock) : clock_(clock) {}

    /// @brief Records the present time.
    /// @satisfies FR-200
    /// @isr{yes}
    void record();

    /// @return the recorded time [us]
    /// @satisfies FR-200
    /// @isr{yes}
    [[nodiscard]] Instant now() const override { return time_; }

    /// @isr{yes}
    [[nodiscard]] std::uint32_t awakeCycles() const override { return clock_.awakeCycles(); }

   private:
    const K64Timebase& clock_;
    Instant time_;
  };

  /// @brief Constructs a clock that is stopped.
  constexpr K64Timebase() = default;

  /// @brief Starts the clock at 0, and the count of cycles.
  /// @pre The clocks of the timers run.
  /// @isr{no}
  /// @satisfies FR-127
  void start();

  /// @pre Two calls are less than 71 s apart.
  /// @satisfies FR-200
  /// @isr{yes}
  [[nodiscard]] Instant now() const override;

  /// @satisfies FR-160
  /// @satisfies FR-302
  /// @satisfies FR-303
  /// @isr{yes}
  [[nodiscard]] std::uint32_t awakeCycles() const override;

  /// @brief Sleeps until an interrupt comes; the interrupt has been served when this method
  /// returns.
  /// @pre No interrupt is being served, and no interrupt is blocked.
  /// @satisfies FR-160
  /// @satisfies FR-302
  /// @isr{no}
  void sleep();

 private:
  /// @brief A time since start, in ticks of the counter.
  /// @datatype
  struct Time {
    std::uint64_t microseconds = 0;
    std::uint32_t ticks = 0;  ///< remaining ticks, less than a microsecond

    /// @brief Returns a later time.
    [[nodiscard]] constexpr Time after(std::uint32_t later) const {
      constexpr std::uint32_t kWhole = K64Board::kTicksPerMicrosecond;
      const std::uint32_t left = ticks + later % kWhole;
      const auto carry = static_cast<std::uint32_t>(left >= kWhole);
      return {microseconds + (later / kWhole + carry), left - carry * kWhole};
    }

    /// @brief Returns the time after one more period of the counter.
    [[nodiscard]] constexpr Time afterPeriod() const { return after(kFirst).after(1); }
  };

  static constexpr std::uint32_t kFirst = 0xFFFFFFFF;  // the counter runs from this value down to 0

  mutable Time begin_;             // begin of the period of the counter
  std::uint32_t sleptCycles_ = 0;  // written while interrupts are blocked
};

}  // namespace wr
