#pragma once

#include <functional>

#include "devices/EdgeInput.hpp"

namespace wr::host {

class HostScheduler;

/// @brief An edge input on the host. By default, the initial level of the input is high, as with a
/// pull-up resistor.
class HostEdgeInput final : public EdgeInput {
 public:
  /// @param scheduler serves the interrupt
  /// @param level initial level
  explicit HostEdgeInput(HostScheduler& scheduler, bool level = true);

  /// @brief Sets the handler of the interrupt.
  /// @param vector function that the interrupt calls
  void connect(std::function<void()> vector);

  /// @brief Puts a level on the pin. After the start of the input, a change of the level raises the
  /// interrupt.
  void drive(bool level);

  void start() override;
  [[nodiscard]] bool level() const override;
  [[nodiscard]] bool acknowledge() override;

 private:
  HostScheduler& scheduler_;
  std::function<void()> vector_;
  bool level_;
  bool started_ = false;
  bool edge_ = false;
};

}  // namespace wr::host
