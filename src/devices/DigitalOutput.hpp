#pragma once

namespace wr {

/// @brief Output with two levels.
/// @function Switches a device outside the microcontroller on and off.
/// @secret The pin that is switched, and the level of this pin at which the device is on.
class DigitalOutput {
 public:
  DigitalOutput(const DigitalOutput&) = delete;
  DigitalOutput& operator=(const DigitalOutput&) = delete;

  /// @brief Switches the output on or off.
  /// @param on true to switch the output on, false to switch it off
  /// @isr{yes}
  virtual void set(bool on) = 0;

 protected:
  DigitalOutput() = default;
  ~DigitalOutput() = default;
};

}  // namespace wr
