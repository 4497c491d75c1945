#pragma once

namespace wr::plant {

/// @brief The steering device with its stepper motor, gear, end stops and switches.
class SteeringGear {
 public:
  static constexpr double kStep = 0.05;  ///< [degree]
  static constexpr int kLastStep = 680;  ///< number of steps from the middle to a mechanical limit
  static constexpr double kSwitch =
      33.5;  ///< angle at which the switch of an end stop opens [degree]

  /// @brief Switches the current of the motor on or off.
  /// @param enabled false: steps are lost
  void enable(bool enabled) { enabled_ = enabled; }

  /// @brief Stalls the motor or releases it. A stalled motor loses all steps.
  /// @param stalled true: the motor stalls; false: the motor is released
  void stall(bool stalled) { stalled_ = stalled; }

  /// @brief Executes one step pulse.
  /// @param left true: to the left; false: to the right
  void step(bool left);

  /// @brief Returns the position of the steering.
  /// @return degrees, positive to the left
  [[nodiscard]] double degrees() const { return steps_ * kStep; }

  /// @brief Returns true if the left end stop is reached.
  [[nodiscard]] bool leftEnd() const { return degrees() >= kSwitch; }

  /// @brief Returns true if the right end stop is reached.
  [[nodiscard]] bool rightEnd() const { return degrees() <= -kSwitch; }

 private:
  bool enabled_ = false;
  bool stalled_ = false;
  int steps_ = 0;
};

}  // namespace wr::plant
