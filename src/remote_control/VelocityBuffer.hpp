#pragma once

#include "remote_control/RcBuffer.hpp"
#include "services/Pipe.hpp"

namespace wr {

/// @brief Buffer of the velocity signal of the remote control.
/// @function Passes the velocity of each pulse to the reader of orders.
/// @secret The velocity of a full deflection of the velocity lever, and the destination of its value.
/// @role{rc-buffers, Concrete Class}
class VelocityBuffer final : public RcBuffer {
 public:
  /// @brief Binds the buffer.
  /// @param instants measures period and width of the pulses
  /// @param function calculates the velocity of a pulse
  /// @param velocity receives the velocity of each pulse, with the time at which it ended
  VelocityBuffer(InstantCollector& instants, const Function& function, Pipe<Velocity>& velocity);

 private:
  /// @brief Returns the greatest velocity that can be ordered.
  /// @return velocity [0.1 rpm]
  /// @satisfies FR-52
  [[nodiscard]] std::int32_t fullDeflection() const override;

  /// @brief Writes the velocity to the pipe.
  /// @param value velocity [0.1 rpm]
  /// @param at end of the pulse
  /// @satisfies FR-52
  void keep(std::int32_t value, Instant at) override;

  Pipe<Velocity>& pipe_;
};

}  // namespace wr
