#pragma once

#include "devices/DigitalOutput.hpp"

namespace wr {

/// @brief An output whose pin has the opposite level: the pin is low while the output is on.
class InvertedOutput final : public DigitalOutput {
 public:
  /// @param pin pin that is low while this output is on
  explicit InvertedOutput(DigitalOutput& pin) : pin_(pin) {}

  /// @brief Sets the pin to the opposite of a level.
  /// @param on true: the pin is low; false: the pin is high
  /// @isr{yes}
  void set(bool on) override { pin_.set(!on); }

 private:
  DigitalOutput& pin_;
};

}  // namespace wr
