#pragma once

#include "units/quantities.hpp"

namespace wr {

/// @brief Output with pulse-width modulation: it is on during a part of each period.
/// @function Sets the mean level of an output to a value between off and on.
/// @secret The length of a period, the timer that generates the periods, and the moment when a new
/// duty cycle takes effect.
class PwmOutput {
 public:
  PwmOutput(const PwmOutput&) = delete;
  PwmOutput& operator=(const PwmOutput&) = delete;

  /// @brief Sets the share of the period in which the output is on.
  /// @param dutyCycle share [0.01 %], 0 to 10000; a greater value has the same effect as 10000
  /// @isr{yes}
  virtual void set(DutyCycle dutyCycle) = 0;

 protected:
  PwmOutput() = default;
  ~PwmOutput() = default;
};

}  // namespace wr
