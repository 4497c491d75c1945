#pragma once

#include <cstdint>

#include "functions/Function.hpp"
#include "sensing/instants/InstantCollector.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Buffer of one signal of the remote control.
/// @function Registers the edges of a signal, and interprets each pulse in the same steps.
/// Subclasses define the value of a full deflection, and store the value.
/// @secret The steps from an edge to a value, and the conditions for a valid pulse.
/// @role{rc-buffers, Abstract Class}
/// @role{functions, Context}
/// @role{rc-pin-interrupt, Receiver}
///
/// @patternapp{rc-buffers, Template Method, RC Buffers}
/// @why The remote control has a velocity signal and a direction signal, at separate pins.
/// Both signals are registered and interpreted in the same steps. They differ only in the meaning
/// and the
/// destination of the value.
/// @changes The meaning of a signal may change with a new remote control. A new signal is a new
/// subclass of this class.
class RcBuffer {
 public:
  RcBuffer(const RcBuffer&) = delete;
  RcBuffer& operator=(const RcBuffer&) = delete;

  /// @brief Processes an edge. A falling edge ends a pulse: when its period is 15 to 30 ms and the
  /// function accepts its width, the value is stored.
  /// @param rising true when the level is high after the edge
  /// @param at time of the edge
  /// @isr{yes}
  /// @satisfies FR-52
  /// @satisfies FR-54
  /// @satisfies FR-55
  void signal(bool rising, Instant at);

 protected:
  /// @brief Binds the buffer.
  /// @param instants measures period and width of the pulses
  /// @param function calculates the value of a pulse; it rejects an impossible width
  RcBuffer(InstantCollector& instants, const Function& function);
  ~RcBuffer() = default;

 private:
  /// @brief Returns the value of a full deflection of the lever.
  /// @return value of a pulse of 2000 us, in the unit of the signal
  [[nodiscard]] virtual std::int32_t fullDeflection() const = 0;

  /// @brief Stores the value of a pulse.
  /// @param value the value, in the unit of the signal
  /// @param at end of the pulse
  virtual void keep(std::int32_t value, Instant at) = 0;

  InstantCollector& instants_;
  const Function& function_;
};

}  // namespace wr
