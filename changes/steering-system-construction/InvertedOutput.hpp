#pragma once

#include "devices/DigitalOutput.hpp"

namespace wr {

/// @brief An output for a device that needs the opposite level.
class InvertedOutput final : public DigitalOutput {
 public:
  /// @param pin pin that gets the opposite level
  explicit InvertedOutput(DigitalOutput& pin) : pin_(pin) {}

  /// @brief Sets the opposite level.
  /// @param on true: the pin is low
  /// @isr{yes}
  void set(bool on) override { pin_.set(!on); }

 private:
  DigitalOutput& pin_;
};

}  // namespace wr
