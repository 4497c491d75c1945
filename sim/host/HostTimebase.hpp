#pragma once

#include <cstdint>

#include "devices/Timebase.hpp"
#include "units/quantities.hpp"

namespace wr::host {

/// @brief Time that stands still until it is advanced by hand.
class HostTimebase final : public Timebase {
 public:
  [[nodiscard]] Instant now() const override { return now_; }
  [[nodiscard]] std::uint32_t awakeCycles() const override { return 0; }

  /// @brief Lets time pass.
  /// @param duration how much
  void advance(Microseconds duration) { now_ = now_ + duration; }

 private:
  Instant now_{0};
};

/// @brief The time of the machine, from the construction of this object.
class RealTimebase final : public Timebase {
 public:
  /// @brief Takes the present time as start.
  RealTimebase();

  [[nodiscard]] Instant now() const override;
  [[nodiscard]] std::uint32_t awakeCycles() const override { return 0; }

  /// @brief Sleeps until an instant; a signal ends the sleep early.
  /// @param instant when to wake up
  void sleepUntil(Instant instant) const;

 private:
  Instant start_;
};

}  // namespace wr::host
