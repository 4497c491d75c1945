#pragma once

#include <cstdint>

#include "remote_control/RcBuffer.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief The buffer of the pulses of the enable switch.
///
/// @function Stores the width and the time of each valid pulse of the third channel of the remote
/// control. If two successive pulses are stop orders, also stores the width and the time of the
/// second pulse in a separate pipe. Only such a pair of pulses changes the content of this pipe.
///
/// @secret The storage of the position of the enable switch, and the number of pulses that confirm
/// a stop.
///
/// @role{rc-buffers, Concrete Class}
class EnableBuffer final : public RcBuffer {
 public:
  /// @param instants measures the period and the width of each pulse
  /// @param function computes the deflection of a pulse
  /// @param width receives the width of each valid pulse, 900 to 2100 us
  /// @param stop receives the width of a pulse that orders a stop, if the previous pulse also
  /// ordered a stop
  EnableBuffer(InstantCollector& instants, const Function& function, Pipe<Microseconds>& width,
               Pipe<Microseconds>& stop);

 private:
  [[nodiscard]] std::int32_t fullDeflection() const override;

  /// @brief Stores the width and the time of a valid pulse. If this pulse and the previous pulse
  /// order a stop, also stores them in the separate pipe.
  /// @param value width of the pulse minus 1500 us [us]
  /// @param at time at which the pulse ended
  /// @satisfies FR-285
  void keep(std::int32_t value, Instant at) override;

  Pipe<Microseconds>& pipe_;
  Pipe<Microseconds>& stop_;
  bool stopBefore_ = false;  // the previous pulse ordered a stop
};

}  // namespace wr
