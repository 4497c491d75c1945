#pragma once

#include <cstdint>

#include "safety/StopMemory.hpp"
#include "services/StartRecord.hpp"

namespace wr {

/// @brief The stop order of a source, stored in memory that a reset does not change.
///
/// @function Stores, together with a check word, whether a stop is in force. Power-on clears the
/// stop. If the content fails its check after any other reset, the content counts as a stop.
///
/// @secret The numbers that mean a stop, and the method by which damaged memory is detected.
class RetainedStop final : public StopMemory {
 public:
  /// @brief The content of the memory.
  /// @datatype
  struct Cells {
    std::uint32_t value;  ///< number that means "stop" or "no stop"
    std::uint32_t check;  ///< bitwise complement of the value
  };

  /// @param cells memory that a reset does not change
  explicit RetainedStop(Cells& cells);

  /// @brief Clears the stop after power-on.
  /// @param cause cause of the last reset
  /// @satisfies FR-290
  /// @isr{no}
  void begin(ResetCause cause);

  /// @brief Returns whether a stop is stored.
  /// @return true if a stop is stored, or if the content fails its check.
  /// @satisfies FR-290
  /// @isr{no}
  [[nodiscard]] bool stopped() const override;

  /// @brief Stores, together with a check word, whether a stop is in force.
  /// @param stopped true while a stop is in force
  /// @satisfies FR-290
  /// @isr{no}
  void save(bool stopped) override;

 private:
  Cells& cells_;
};

}  // namespace wr
