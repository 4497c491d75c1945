#pragma once

#include "remote_control/RcBuffer.hpp"
#include "services/Pipe.hpp"

namespace wr {

/// @brief Buffer of the velocity signal of the remote control.
/// @function Defines the velocity of a full deflection, and writes the velocity of each pulse to a
/// pipe.
/// @secret The velocity for a full deflection of the velocity stick, and the destination of the
/// velocity.
/// @role{rc-buffers, Concrete Class}
class VelocityBuffer final : public RcBuffer {
 public:
  /// @param instants measures period and width of the pulses
  /// @param function calculates the velocity of a pulse
  /// @param velocity pipe that receives each velocity and the time at which its pulse ended
  VelocityBuffer(InstantCollector& instants, const Function& function, Pipe<Velocity>& velocity);

 private:
  /// @brief Returns the greatest velocity that can be ordered.
  /// @return velocity [0.1 rpm]
  /// @satisfies FR-52
  [[nodiscard]] std::int32_t fullDeflection() const override;

  /// @brief Writes the velocity to the pipe.
  /// @param value velocity [0.1 rpm]
  /// @param at time at which the pulse ended
  /// @satisfies FR-52
  void keep(std::int32_t value, Instant at) override;

  Pipe<Velocity>& pipe_;
};

}  // namespace wr
