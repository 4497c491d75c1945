#pragma once

#include "devices/Timebase.hpp"
#include "sensing/velocity/ActiveSensor.hpp"
#include "sensing/velocity/SensorCollector.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief Command of an edge of a Hall sensor: collects the edge.
/// @function Passes the levels after an edge, with their time, to the collector.
/// @secret Which module acts on an edge of a Hall sensor, and the values that it gets.
/// @role{hall-interrupt, Concrete Command}
///
/// @patternapp{hall-interrupt, Command, Process Hall sensor interruptions}
/// @why An edge of a Hall sensor causes an interrupt. The sensor executes a command object, so it
/// names no
/// module that acts on the edge.
/// @changes The actions at an edge, or the modules that they affect, may change without change to
/// the sensor.
class CountSignal final : public Command {
 public:
  /// @brief Binds the command to sensor and collector.
  /// @param collector receives the edges
  /// @param sensor returns the levels
  /// @param timebase returns the time of an edge
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
