#pragma once

#include <cstdint>

#include "devices/EdgeInput.hpp"
#include "services/Command.hpp"

namespace wr {

/// @brief The two Hall sensors of a wheel.
/// @function Causes an interrupt at each edge of either sensor, executes its command, and returns
/// the present levels of both.
/// @secret The hardware that detects the rotation of a wheel.
/// @role{hall-interrupt, Invoker}
class ActiveSensor final {
 public:
  /// @brief Binds the inputs of both sensors and the command.
  /// @param a first sensor
  /// @param b second sensor, a quarter of a period behind the first when the wheel turns forwards
  /// @param command is executed at each edge
  ActiveSensor(EdgeInput& a, EdgeInput& b, Command& command);

  ActiveSensor(const ActiveSensor&) = delete;
  ActiveSensor& operator=(const ActiveSensor&) = delete;

  /// @brief Enables the interrupts of both sensors. First executes the command once, so that the
  /// counter has the position of the wheel.
  /// @isr{no}
  /// @satisfies FR-120
  void start();

  /// @brief Serves an interrupt: acknowledges each sensor that had an edge, and executes the
  /// command once if any sensor had an edge. The vector of the port calls this function.
  /// @isr{yes}
  /// @satisfies FR-120
  void serve();

  /// @brief Returns the present levels.
  /// @return bit 0 is set when the first sensor is high, bit 1 when the second is [0 to 3]
  /// @isr{yes}
  /// @satisfies FR-120
  [[nodiscard]] std::uint8_t phase() const;

 private:
  EdgeInput& a_;
  EdgeInput& b_;
  Command& command_;
};

}  // namespace wr
