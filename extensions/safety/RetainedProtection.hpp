#pragma once

#include <cstdint>

#include "services/StartRecord.hpp"
#include "units/Measurements.hpp"

namespace wr {

/// @brief The latched protective stop in memory that a reset does not change.
///
/// @function Stores the cause of the protective stop and its wheel, with a check word. After
/// power-on there is no protective stop. After a loss of the clock there is a protective stop.
/// After any other reset, content that fails its check counts as a protective stop because of a
/// missing measurement.
///
/// @secret How a protective stop is encoded, and how damaged memory is detected.
class RetainedProtection final {
 public:
  /// @brief The content of the memory.
  /// @datatype
  struct Cells {
    std::uint32_t value;  ///< the encoded protective stop
    std::uint32_t check;  ///< complement of the value
  };

  /// @brief A protective stop.
  /// @datatype
  struct Stop {
    StopCause cause = StopCause::None;          ///< cause of the stop; None: no protective stop
    std::uint8_t wheel = Protection::kNoWheel;  ///< wheel that the cause concerns, 0 to 3

    /// @brief Compares two protective stops.
    friend constexpr bool operator==(const Stop&, const Stop&) = default;
  };

  /// @brief Binds the object to its memory.
  /// @param cells memory that a reset does not change
  explicit RetainedProtection(Cells& cells);

  RetainedProtection(const RetainedProtection&) = delete;
  RetainedProtection& operator=(const RetainedProtection&) = delete;

  /// @brief Checks the cause of the start. After power-on there is no protective stop. After a loss of
  /// the clock there is a protective stop.
  /// @param start cause of the last reset, and the fault before it
  /// @satisfies FR-291
  /// @isr{no}
  void begin(const StartRecord& start);

  /// @brief Returns the stored protective stop.
  /// @return its cause and its wheel; MissingMeasurement if the content fails its check.
  /// @satisfies FR-291
  /// @isr{no}
  [[nodiscard]] Stop stored() const;

  /// @brief Stores a protective stop with its check word.
  /// @param stop the protective stop; the cause None after an acknowledgement
  /// @satisfies FR-291
  /// @isr{no}
  void save(const Stop& stop);

 private:
  Cells& cells_;
};

}  // namespace wr
