#pragma once

#include <array>
#include <cstddef>
#include <optional>

namespace wr::plant {

/// @brief The two Hall sensors of one motor. While the motor turns forwards, their levels (b, a)
/// have the sequence 00, 01, 11, 10. One turn of the shaft has 60 edges.
class HallSensors {
 public:
  static constexpr double kEdgesPerTurn = 60.0;
  /// Half of the hysteresis, as a fraction of the distance between two edges. The hysteresis is the
  /// distance by which the shaft must turn back before an edge is reversed.
  static constexpr double kHysteresis = 0.05;

  /// @brief Sets the positions of the sensors.
  /// @param misplaced displacement of each sensor, as a fraction of the distance between two edges
  void place(const std::array<double, 2>& misplaced) { misplaced_ = misplaced; }

  /// @brief Updates the level of a sensor after a movement of the shaft. The movement must be
  /// shorter than the distance between two edges.
  /// @param sensor 0 for a, 1 for b
  /// @param from turns of the shaft before the movement
  /// @param to turns of the shaft after the movement
  /// @return fraction of the movement at which the level changed; nothing if the level did not
  /// change
  [[nodiscard]] std::optional<double> turn(std::size_t sensor, double from, double to);

  /// @brief Returns the level of a sensor.
  /// @param sensor 0 for a, 1 for b
  [[nodiscard]] bool level(std::size_t sensor) const { return levels_.at(sensor); }

 private:
  std::array<double, 2> misplaced_{};
  std::array<bool, 2> levels_{};
};

}  // namespace wr::plant
