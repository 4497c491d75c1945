#pragma once

#include <functional>

#include "devices/DigitalOutput.hpp"

namespace wr::host {

/// @brief A digital output on the host.
class HostDigitalOutput final : public DigitalOutput {
 public:
  HostDigitalOutput() = default;

  void set(bool on) override;

  /// @brief Returns true if the output is on.
  [[nodiscard]] bool isOn() const { return on_; }

  /// @brief Sets the callback for each change of the output from off to on.
  void onRise(std::function<void()> call);

 private:
  bool on_ = false;
  std::function<void()> rise_;
};

}  // namespace wr::host
