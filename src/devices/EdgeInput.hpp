#pragma once

namespace wr {

/// @brief Input with two levels that can cause an interrupt when its level changes.
/// @function Reads the level of a pin, and causes an interrupt at each of its edges.
/// @secret The pin, and how its edges are detected and acknowledged.
class EdgeInput {
 public:
  EdgeInput(const EdgeInput&) = delete;
  EdgeInput& operator=(const EdgeInput&) = delete;

  /// @brief Enables the interrupt of each edge. Without this call only the level of the input can
  /// be read.
  /// @isr{no}
  virtual void start() = 0;

  /// @brief Returns the present level.
  /// @return true for high
  /// @isr{yes}
  [[nodiscard]] virtual bool level() const = 0;

  /// @brief Returns whether the level changed since the last call, and acknowledges its interrupt.
  /// @return true after an edge
  /// @isr{yes}
  [[nodiscard]] virtual bool acknowledge() = 0;

 protected:
  EdgeInput() = default;
  ~EdgeInput() = default;
};

}  // namespace wr
