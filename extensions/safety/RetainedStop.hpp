#pragma once

#include <cstdint>

#include "safety/StopMemory.hpp"
#include "services/StartRecord.hpp"

namespace wr {

/// @brief A stop in memory that a reset does not change.
///
/// @function Stores the stop with a check word. After power-on there is no stop; after any other
/// reset, content that fails its check counts as a stop.
///
/// @secret Which numbers mean a stop, and how damaged memory is detected.
class RetainedStop final : public StopMemory {
 public:
  /// @brief The content of the memory.
  /// @datatype
  struct Cells {
    std::uint32_t value;  ///< number of the state
    std::uint32_t check;  ///< complement of the value
  };

  /// @brief Binds the object to its memory.
  /// @param cells memory that a reset does not change
  explicit RetainedStop(Cells& cells);

  /// @brief Checks the cause of the last reset: after power-on there is no stop.
  /// @param cause cause of the last reset
  /// @satisfies FR-290
  /// @isr{no}
  void begin(ResetCause cause);

  /// @brief Returns the stored value.
  /// @return true if a stop is stored, or if the content fails its check.
  /// @satisfies FR-290
  /// @isr{no}
  [[nodiscard]] bool stopped() const override;

  /// @brief Stores a value with its check word.
  /// @param stopped true while a stop is in force
  /// @satisfies FR-290
  /// @isr{no}
  void save(bool stopped) override;

 private:
  Cells& cells_;
};

}  // namespace wr
