#pragma once

#include <cstdint>

#include "functions/Function.hpp"
#include "sensing/instants/InstantCollector.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Buffer of one signal of the remote control.
/// @function Registers the edges of a signal, and converts each pulse to a value. Subclasses define
/// the value for a full deflection, and store the value of each pulse.
/// @secret The steps that convert the edges of a pulse to a value, and the conditions for a valid
/// pulse.
/// @role{rc-buffers, Abstract Class}
/// @role{functions, Context}
/// @role{rc-pin-interrupt, Receiver}
///
/// @patternapp{rc-buffers, Template Method, RC Buffers}
/// @why The remote control has a velocity signal and a direction signal, at separate pins.
/// Both signals are registered and interpreted in the same steps. The two signals differ only in
/// the meaning and the destination of the value.
/// @changes A new remote control may change the meaning of a signal. A new signal needs a new
/// subclass of this class.
class RcBuffer {
 public:
  RcBuffer(const RcBuffer&) = delete;
  RcBuffer& operator=(const RcBuffer&) = delete;

  /// @brief Records an edge of the signal. A falling edge ends a pulse. The value of this pulse
  /// is stored if three conditions are met: the period is 15 to 30 ms, the pulse is shorter than
  /// the period, and the function accepts the width of the pulse. The period is the time between
  /// the beginnings of the previous pulse and of this pulse.
  /// @param rising true when the level is high after the edge
  /// @param at time of the edge
  /// @isr{yes}
  /// @satisfies FR-52
  /// @satisfies FR-54
  /// @satisfies FR-55
  void signal(bool rising, Instant at);

 protected:
  /// @param instants measures period and width of the pulses
  /// @param function calculates the value of a pulse; it rejects an impossible width
  RcBuffer(InstantCollector& instants, const Function& function);
  ~RcBuffer() = default;

 private:
  /// @brief Returns the value for a full deflection of the stick.
  /// @return value of a pulse of 2000 us, in the unit of the signal
  [[nodiscard]] virtual std::int32_t fullDeflection() const = 0;

  /// @brief Stores the value of a pulse.
  /// @param value the value, in the unit of the signal
  /// @param at time at which the pulse ended
  virtual void keep(std::int32_t value, Instant at) = 0;

  InstantCollector& instants_;
  const Function& function_;
};

}  // namespace wr
