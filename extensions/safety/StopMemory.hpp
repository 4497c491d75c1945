#pragma once

namespace wr {

/// @brief A memory for the stop order of one source. A reset does not clear this memory.
///
/// @function Stores whether a stop is in force.
///
/// @secret The place in which the stop is stored, and the protection of the stored value.
class StopMemory {
 public:
  StopMemory(const StopMemory&) = delete;
  StopMemory& operator=(const StopMemory&) = delete;

  /// @brief Returns whether a stop is stored.
  /// @return true if a stop is stored, or if the content of the memory fails its check.
  /// @isr{no}
  [[nodiscard]] virtual bool stopped() const = 0;

  /// @brief Stores whether a stop is in force.
  /// @param stopped true while a stop is in force
  /// @isr{no}
  virtual void save(bool stopped) = 0;

 protected:
  StopMemory() = default;
  ~StopMemory() = default;
};

}  // namespace wr
