#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "units/quantities.hpp"

namespace wr {

/// @brief A detector of a remote control whose pulses no longer change.
///
/// @function Compares the pulses of all channels with the pulses at the last change. Measures the
/// time for which the remote control has moved the robot since this change.
///
/// @secret The greatest change of a pulse that counts as jitter, and the longest permitted time
/// without a greater change.
class RcVigilance final {
 public:
  static constexpr std::size_t kChannels = 3;  ///< velocity, direction, enable

  /// @brief Deflections of all channels [us].
  using Deflections = std::array<std::int32_t, kChannels>;

  /// @brief Constructs a detector that has received no pulses yet.
  RcVigilance() = default;
  RcVigilance(const RcVigilance&) = delete;
  RcVigilance& operator=(const RcVigilance&) = delete;

  /// @brief Checks whether the pulses no longer change while the remote control moves the robot.
  /// @param deflections newest deflections of all channels
  /// @param moving true while the remote control orders a motion
  /// @param now present time
  /// @return true if two conditions were met for more than 2 s: the remote control moved the robot,
  /// and each channel stayed within 8 us of its value at the last change.
  /// @satisfies FR-289
  /// @isr{no}
  [[nodiscard]] bool expired(const Deflections& deflections, bool moving, Instant now);

 private:
  Deflections reference_{};
  Instant changedAt_{};
};

}  // namespace wr
