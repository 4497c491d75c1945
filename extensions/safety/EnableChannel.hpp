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

/// @brief The objects that process the third channel of the remote control, from the edges of its
/// pin to the width of its pulses.
/// @datatype
struct EnableChannel {
  /// @brief Enables the interrupt of the pin.
  /// @param input pin of the channel
  /// @param timebase returns the time of an edge
  EnableChannel(EdgeInput& input, const Timebase& timebase)
      : period(instants),
        collector(period),
        buffer(collector, function, width, stop),
        pin(input, readPin),
        readPin(buffer, pin, timebase) {
    pin.start();
  }

  Pipe<Microseconds> width;  ///< width of each valid pulse, 900 to 2100 us
  Pipe<Microseconds> stop;   ///< width of a pulse that orders a stop, if the previous pulse also
                             ///< ordered a stop
  BasicCollector instants;   ///< stores the time of the last edge
  PeriodCollector period;    ///< measures the period of the pulses
  WidthCollector collector;  ///< measures the width of a pulse
  PulsePosition function;    ///< computes the deflection from the width of a pulse
  EnableBuffer buffer;       ///< stores the widths of the pulses
  RcPin pin;                 ///< pin of the channel
  ReadRcPin readPin;         ///< command that each edge executes
};

}  // namespace wr
