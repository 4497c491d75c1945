#pragma once

#include "units/quantities.hpp"

namespace wr {

/// @brief Output that is on for a part of each period.
/// @function Sets the mean of an output between off and on.
/// @secret Which timer generates the periods, how long they are, and when a new share takes effect.
class PwmOutput {
 public:
  PwmOutput(const PwmOutput&) = delete;
  PwmOutput& operator=(const PwmOutput&) = delete;

  /// @brief Sets the share of the period in which the output is on.
  /// @param dutyCycle share [0.01 %], 0 to 10000; a greater value counts as the limit
  /// @isr{yes}
  virtual void set(DutyCycle dutyCycle) = 0;

 protected:
  PwmOutput() = default;
  ~PwmOutput() = default;
};

}  // namespace wr
