#pragma once

namespace wr {

/// @brief Memory of a stop that a reset does not clear.
///
/// @function Stores whether a stop is in force.
///
/// @secret Where the stop is stored, and how its content is protected.
class StopMemory {
 public:
  StopMemory(const StopMemory&) = delete;
  StopMemory& operator=(const StopMemory&) = delete;

  /// @brief Returns the stored value.
  /// @return true if a stop was in force, or if the content fails its check.
  /// @isr{no}
  [[nodiscard]] virtual bool stopped() const = 0;

  /// @brief Stores a value.
  /// @param stopped true while a stop is in force
  /// @isr{no}
  virtual void save(bool stopped) = 0;

 protected:
  StopMemory() = default;
  ~StopMemory() = default;
};

}  // namespace wr
