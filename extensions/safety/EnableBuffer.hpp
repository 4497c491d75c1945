#pragma once

#include <cstdint>

#include "remote_control/RcBuffer.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Receives the pulses of the enable switch.
///
/// @function Stores the width of each pulse of the third channel of the remote control with its time.
/// The second of two successive pulses that order a stop is also stored separately, so that a later
/// pulse does not hide the stop.
///
/// @secret Where the position of the enable switch is stored, and how many pulses confirm a stop.
///
/// @role{rc-buffers, Concrete Class}
class EnableBuffer final : public RcBuffer {
 public:
  /// @brief Binds the buffer to its parts.
  /// @param instants measures each pulse
  /// @param function computes the deflection of a pulse
  /// @param width receives the width of each pulse from 900 to 2100 us
  /// @param stop receives the width of each pulse that orders a stop directly after another pulse
  /// that orders a stop
  EnableBuffer(InstantCollector& instants, const Function& function, Pipe<Microseconds>& width,
               Pipe<Microseconds>& stop);

 private:
  [[nodiscard]] std::int32_t fullDeflection() const override;

  /// @brief Stores the width of a pulse, and the second pulse of a stop.
  /// @param value deflection from the middle [us]
  /// @param at end of the pulse
  /// @satisfies FR-285
  void keep(std::int32_t value, Instant at) override;

  Pipe<Microseconds>& pipe_;
  Pipe<Microseconds>& stop_;
  bool stopBefore_ = false;  // the previous pulse ordered a stop
};

}  // namespace wr
