#pragma once

#include "devices/Timebase.hpp"
#include "sensing/velocity/ActiveSensor.hpp"
#include "sensing/velocity/SensorCollector.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief Counts the edges of Hall sensors that are mounted on the other side of the motor.
///
/// Their two signals have changed places.
class CountMirroredSignal final : public Command {
 public:
  /// @brief Binds the command to sensor and collector.
  /// @param collector receives the edges
  /// @param sensor returns the levels
  /// @param timebase returns the time of an edge
  CountMirroredSignal(SensorCollector& collector, const ActiveSensor& sensor,
                      const Timebase& timebase)
      : collector_(collector), sensor_(sensor), timebase_(timebase) {}

  /// @brief Exchanges the two present levels, and passes them with the time to the collector.
  /// @isr{yes}
  void execute() override {
    const unsigned phase = sensor_.phase();
    const auto mirrored = static_cast<std::uint8_t>((phase & 1U) << 1U | phase >> 1U);
    collector_.collect(mirrored, timebase_.now());
  }

 private:
  SensorCollector& collector_;
  const ActiveSensor& sensor_;
  const Timebase& timebase_;
};

}  // namespace wr
