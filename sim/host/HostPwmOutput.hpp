#pragma once

#include "devices/PwmOutput.hpp"
#include "units/quantities.hpp"

namespace wr::host {

/// @brief A PWM output on the host.
class HostPwmOutput final : public PwmOutput {
 public:
  HostPwmOutput() = default;

  void set(DutyCycle dutyCycle) override;

  /// @brief Returns the duty cycle that was set, limited to the range of the output.
  /// @return duty cycle [0.01 %], 0 to 10000; 0 before the first call of set()
  [[nodiscard]] DutyCycle dutyCycle() const { return dutyCycle_; }

 private:
  DutyCycle dutyCycle_{};
};

}  // namespace wr::host
