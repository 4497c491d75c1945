#pragma once

namespace wr {

/// @brief Input with two levels that can cause an interrupt when its level changes.
/// @function Reads the level of a pin, and causes an interrupt at each edge, that is, at each
/// change of the level.
/// @secret The pin that is read, and the method by which edges are detected and acknowledged.
class EdgeInput {
 public:
  EdgeInput(const EdgeInput&) = delete;
  EdgeInput& operator=(const EdgeInput&) = delete;

  /// @brief Enables the interrupts at both edges. Without this call only the level of the input can
  /// be read.
  /// @isr{no}
  virtual void start() = 0;

  /// @brief Returns the present level.
  /// @return true for high
  /// @isr{yes}
  [[nodiscard]] virtual bool level() const = 0;

  /// @brief Returns whether an edge has occurred since the last call, and acknowledges the
  /// interrupt of the edge.
  /// @return true after an edge
  /// @isr{yes}
  [[nodiscard]] virtual bool acknowledge() = 0;

 protected:
  EdgeInput() = default;
  ~EdgeInput() = default;
};

}  // namespace wr
