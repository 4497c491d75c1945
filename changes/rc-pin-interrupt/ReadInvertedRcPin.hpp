#pragma once

#include "devices/Timebase.hpp"
#include "remote_control/RcBuffer.hpp"
#include "remote_control/RcPin.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief A command that reads a receiver of the remote control. The pulses of this receiver are
/// inverted: the level is low during a pulse.
class ReadInvertedRcPin final : public Command {
 public:
  /// @param buffer receives the edges
  /// @param pin returns the level of the signal
  /// @param timebase returns the time of an edge
  ReadInvertedRcPin(RcBuffer& buffer, const RcPin& pin, const Timebase& timebase)
      : buffer_(buffer), pin_(pin), timebase_(timebase) {}

  /// @brief Passes the opposite of the present level to the buffer, together with the time.
  /// @isr{yes}
  void execute() override { buffer_.signal(!pin_.level(), timebase_.now()); }

 private:
  RcBuffer& buffer_;
  const RcPin& pin_;
  const Timebase& timebase_;
};

}  // namespace wr
