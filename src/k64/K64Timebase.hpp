#pragma once

#include <cstdint>

#include "devices/Timebase.hpp"
#include "k64/K64Board.hpp"

namespace wr {

/// @brief Timebase of the K64. Channel 2 of the periodic interrupt timer measures the time since
/// start. The cycle counter of the core counts the processor cycles.
/// @function Returns the time in microseconds to threads and interrupts. Lets the core sleep, and
/// returns the number of processor cycles in which the core did not sleep.
/// @secret The computation of the time from a 32-bit down counter, without overflow and without a
/// 64-bit division. The method that counts the processor cycles, even if the cycle counter stops
/// while the core sleeps.
class K64Timebase final : public Timebase {
 public:
  /// @brief Time at which the handler of an interrupt was entered. The handler uses this time for
  /// all signals that it serves. Thus the work for one signal does not change the time of the next
  /// signal.
  class EntryTime final : public Timebase {
   public:
    /// @param clock the timebase; it must exist as long as this object
    explicit constexpr EntryTime(const K64Timebase& clock) : clock_(clock) {}

    /// @brief Records the present time.
    /// @isr{yes}
    void record();

    /// @return the recorded time [us]
    /// @isr{yes}
    [[nodiscard]] Instant now() const override { return time_; }

    /// @isr{yes}
    [[nodiscard]] std::uint32_t awakeCycles() const override { return clock_.awakeCycles(); }

   private:
    const K64Timebase& clock_;
    Instant time_;
  };

  /// @brief Constructs a timebase that does not run yet.
  constexpr K64Timebase() = default;

  /// @brief Starts the time at 0, and starts the cycle counter.
  /// @pre The clock gates of the timers are open: K64Board::openGates() was called.
  /// @isr{no}
  /// @satisfies FR-127
  void start();

  /// @pre The previous call was less than 71 s ago; otherwise an overflow of the counter could be
  /// missed.
  /// @satisfies FR-200
  /// @isr{yes}
  [[nodiscard]] Instant now() const override;

  /// @satisfies FR-160
  /// @satisfies FR-302
  /// @satisfies FR-303
  /// @isr{yes}
  [[nodiscard]] std::uint32_t awakeCycles() const override;

  /// @brief Sleeps until an interrupt occurs. When this method returns, the handler of the
  /// interrupt has already run.
  /// @pre No handler of an interrupt is running, and no interrupt is blocked.
  /// @satisfies FR-160
  /// @satisfies FR-302
  /// @isr{no}
  void sleep();

 private:
  /// @brief A time since start, in microseconds and bus clocks.
  /// @datatype
  struct Time {
    std::uint64_t microseconds = 0;
    std::uint32_t ticks = 0;  ///< bus clocks after the last whole microsecond

    /// @brief Returns this time plus a number of bus clocks.
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

  mutable Time begin_;             // time at which the counter started its present period
  std::uint32_t sleptCycles_ = 0;  // processor cycles; written only while interrupts are blocked
};

}  // namespace wr
