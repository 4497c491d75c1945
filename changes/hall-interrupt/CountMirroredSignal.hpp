#pragma once

#include "devices/Timebase.hpp"
#include "sensing/velocity/ActiveSensor.hpp"
#include "sensing/velocity/SensorCollector.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief A command that counts the edges of Hall sensors. The sensors are not on the usual side of
/// the motor, but on the other side.
///
/// On the usual side, sensor a sends signal a, and sensor b sends signal b. On the other side,
/// sensor a sends signal b, and sensor b sends signal a.
class CountMirroredSignal final : public Command {
 public:
  /// @param collector receives the edges
  /// @param sensor returns the levels of the two signals
  /// @param timebase returns the time of an edge
  CountMirroredSignal(SensorCollector& collector, const ActiveSensor& sensor,
                      const Timebase& timebase)
      : collector_(collector), sensor_(sensor), timebase_(timebase) {}

  /// @brief Exchanges the present levels of the two signals, then passes the levels and the time to
  /// the collector.
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
