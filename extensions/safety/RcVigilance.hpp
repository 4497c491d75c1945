#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "units/quantities.hpp"

namespace wr {

/// @brief Detects a remote control whose pulses no longer change.
///
/// @function Compares the pulses of all channels with the pulses at the last change, and measures
/// how long the remote control has moved the robot without a change.
///
/// @secret The change of a pulse that shows that a person holds the remote control, and how often
/// this change is expected.
class RcVigilance final {
 public:
  static constexpr std::size_t kChannels = 3;  ///< velocity, direction, enable

  /// @brief Deflections of all channels [us].
  using Deflections = std::array<std::int32_t, kChannels>;

  /// @brief Begins without pulses.
  RcVigilance() = default;
  RcVigilance(const RcVigilance&) = delete;
  RcVigilance& operator=(const RcVigilance&) = delete;

  /// @brief Checks the pulses of a cycle.
  /// @param deflections newest deflections of all channels
  /// @param moving true while the remote control orders a motion
  /// @param now present time
  /// @return true if the pulses of a moving robot have not changed for too long.
  /// @satisfies FR-289
  /// @isr{no}
  [[nodiscard]] bool expired(const Deflections& deflections, bool moving, Instant now);

 private:
  Deflections reference_{};
  Instant changedAt_{};
};

}  // namespace wr
