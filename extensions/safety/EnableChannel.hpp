#pragma once

#include "devices/EdgeInput.hpp"
#include "devices/Timebase.hpp"
#include "remote_control/RcPin.hpp"
#include "remote_control/ReadRcPin.hpp"
#include "safety/EnableBuffer.hpp"
#include "safety/PulsePosition.hpp"
#include "sensing/instants/BasicCollector.hpp"
#include "sensing/instants/PeriodCollector.hpp"
#include "sensing/instants/WidthCollector.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief The third channel of the remote control, from its pin to the width of its pulses.
/// @datatype
struct EnableChannel {
  /// @brief Constructs the channel, and enables the interrupt of its pin.
  /// @param input pin of the channel
  /// @param timebase returns the time of its edges
  EnableChannel(EdgeInput& input, const Timebase& timebase)
      : period(instants),
        collector(period),
        buffer(collector, function, width, stop),
        pin(input, readPin),
        readPin(buffer, pin, timebase) {
    pin.start();
  }

  Pipe<Microseconds> width;  ///< width of the channel's pulses
  Pipe<Microseconds> stop;   ///< width of the pulses that confirm a stop
  BasicCollector instants;   ///< instants of the channel's edges
  PeriodCollector period;    ///< period of the channel's pulses
  WidthCollector collector;  ///< width of a pulse
  PulsePosition function;    ///< computes the position from a pulse
  EnableBuffer buffer;       ///< stores the position
  RcPin pin;                 ///< pin of the channel
  ReadRcPin readPin;         ///< command that the edges execute
};

}  // namespace wr
