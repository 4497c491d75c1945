#pragma once

#include <cstdint>

#include "services/StartRecord.hpp"
#include "units/Measurements.hpp"

namespace wr {

/// @brief The latched protective stop, stored in memory that a reset does not change.
///
/// @function Stores the cause of the protective stop, the wheel with the fault, and a check word.
/// Power-on clears the protective stop. A loss of the clock causes a protective stop. If the
/// content is damaged, every reset except power-on causes a protective stop with the cause
/// MissingMeasurement.
///
/// @secret The encoding of a protective stop, and the method by which damaged memory is detected.
class RetainedProtection final {
 public:
  /// @brief The content of the memory.
  /// @datatype
  struct Cells {
    std::uint32_t value;  ///< the encoded protective stop
    std::uint32_t check;  ///< bitwise complement of the value
  };

  /// @brief A protective stop.
  /// @datatype
  struct Stop {
    StopCause cause = StopCause::None;          ///< cause of the stop; None: no protective stop
    std::uint8_t wheel = Protection::kNoWheel;  ///< wheel with the fault: 0 to 3, or kNoWheel

    /// @brief Compares two protective stops.
    friend constexpr bool operator==(const Stop&, const Stop&) = default;
  };

  /// @param cells memory that a reset does not change
  explicit RetainedProtection(Cells& cells);

  RetainedProtection(const RetainedProtection&) = delete;
  RetainedProtection& operator=(const RetainedProtection&) = delete;

  /// @brief Clears the protective stop after power-on. Stores a protective stop after a loss of the
  /// clock, if no protective stop is stored.
  /// @param start cause of the last reset, and the fault before this reset
  /// @satisfies FR-291
  /// @isr{no}
  void begin(const StartRecord& start);

  /// @brief Returns the stored protective stop.
  /// @return cause and wheel of the protective stop. If the content fails its check, the cause is
  /// MissingMeasurement.
  /// @satisfies FR-291
  /// @isr{no}
  [[nodiscard]] Stop stored() const;

  /// @brief Stores a protective stop with its check word.
  /// @param stop the protective stop; after an acknowledgement its cause is None
  /// @satisfies FR-291
  /// @isr{no}
  void save(const Stop& stop);

 private:
  Cells& cells_;
};

}  // namespace wr
