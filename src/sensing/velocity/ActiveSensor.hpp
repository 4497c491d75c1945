#pragma once

#include <cstdint>

#include "devices/EdgeInput.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief The two Hall sensors of a wheel.
/// @function Causes an interrupt at each edge of one of the sensors, and executes a command in this
/// interrupt. Returns the present levels of both sensors.
/// @secret The hardware that detects the rotation of a wheel.
/// @role{hall-interrupt, Invoker}
class ActiveSensor final {
 public:
  /// @param a input of the first sensor
  /// @param b input of the second sensor; when the wheel turns forwards, the signal of this sensor
  /// is a quarter of a period behind the signal of the first sensor
  /// @param command command that is executed at each edge
  ActiveSensor(EdgeInput& a, EdgeInput& b, Command& command);

  ActiveSensor(const ActiveSensor&) = delete;
  ActiveSensor& operator=(const ActiveSensor&) = delete;

  /// @brief Executes the command once, to record the present levels of both sensors. Then enables
  /// the interrupts of both sensors.
  /// @isr{no}
  /// @satisfies FR-120
  void start();

  /// @brief Serves an interrupt. Acknowledges the edge of each sensor that had an edge. If at least
  /// one sensor had an edge, executes the command once. The interrupt handler of the port calls
  /// this function.
  /// @isr{yes}
  /// @satisfies FR-120
  void serve();

  /// @brief Returns the present levels of both sensors.
  /// @return levels [0 to 3]; bit 0 is 1 if the first sensor is high, and bit 1 is 1 if the second
  /// sensor is high
  /// @isr{yes}
  /// @satisfies FR-120
  [[nodiscard]] std::uint8_t phase() const;

 private:
  EdgeInput& a_;
  EdgeInput& b_;
  Command& command_;
};

}  // namespace wr
