#pragma once

#include "devices/Timebase.hpp"
#include "sensing/velocity/ActiveSensor.hpp"
#include "sensing/velocity/SensorCollector.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief Command that is executed at each edge of a Hall sensor.
/// @function Passes the levels after an edge, and the time of the edge, to the collector.
/// @secret The module that reacts to an edge of a Hall sensor, and the values that this module
/// receives.
/// @role{hall-interrupt, Concrete Command}
///
/// @patternapp{hall-interrupt, Command, Process Hall sensor interruptions}
/// @why An edge of a Hall sensor causes an interrupt. In this interrupt, the sensor executes a
/// command object. Therefore the class of the sensor does not name the module that reacts to the
/// edge.
/// @changes The actions at an edge, and the affected modules, may change. The sensor does not
/// change.
class CountSignal final : public Command {
 public:
  /// @param collector receives the edges
  /// @param sensor returns the levels
  /// @param timebase returns the present time, which counts as the time of the edge
  CountSignal(SensorCollector& collector, const ActiveSensor& sensor, const Timebase& timebase);

  /// @brief Passes the present levels and the time to the collector.
  /// @isr{yes}
  /// @satisfies FR-120
  void execute() override;

 private:
  SensorCollector& collector_;
  const ActiveSensor& sensor_;
  const Timebase& timebase_;
};

}  // namespace wr
