#pragma once

namespace wr {

/// @brief Input with two levels that can interrupt when its level changes.
/// @function Reads the level of a pin, and interrupts at each of its edges.
/// @secret Which pin it is, and how its edges are found and acknowledged.
class EdgeInput {
 public:
  EdgeInput(const EdgeInput&) = delete;
  EdgeInput& operator=(const EdgeInput&) = delete;

  /// @brief Enables the interrupt of each edge. Without it the input only has a level.
  /// @isr{no}
  virtual void start() = 0;

  /// @brief Returns the present level.
  /// @return true for high
  /// @isr{yes}
  [[nodiscard]] virtual bool level() const = 0;

  /// @brief Returns whether an edge came since the last call, and acknowledges its interrupt.
  /// @return true after an edge
  /// @isr{yes}
  [[nodiscard]] virtual bool acknowledge() = 0;

 protected:
  EdgeInput() = default;
  ~EdgeInput() = default;
};

}  // namespace wr
