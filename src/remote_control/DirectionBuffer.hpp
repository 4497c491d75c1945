#pragma once

#include "remote_control/RcBuffer.hpp"
#include "services/Pipe.hpp"

namespace wr {

/// @brief Buffer of the direction signal of the remote control.
/// @function Defines the angle of a full deflection, and writes the angle of each pulse to a pipe.
/// @secret The angle for a full deflection of the direction stick, and the destination of the
/// angle.
/// @role{rc-buffers, Concrete Class}
class DirectionBuffer final : public RcBuffer {
 public:
  /// @param instants measures period and width of the pulses
  /// @param function calculates the angle of a pulse
  /// @param direction pipe that receives each angle and the time at which its pulse ended
  DirectionBuffer(InstantCollector& instants, const Function& function, Pipe<Angle>& direction);

 private:
  /// @brief Returns the greatest angle that can be ordered.
  /// @return angle [0.01 degree]
  /// @satisfies FR-52
  [[nodiscard]] std::int32_t fullDeflection() const override;

  /// @brief Writes the angle to the pipe.
  /// @param value angle [0.01 degree]
  /// @param at time at which the pulse ended
  /// @satisfies FR-52
  void keep(std::int32_t value, Instant at) override;

  Pipe<Angle>& pipe_;
};

}  // namespace wr
