#pragma once

#include <cstdint>

#include "units/Measurements.hpp"
#include "units/SetPoints.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Counts of errors on the PC link since start. Each count stops at 65535.
/// @datatype
struct LinkCounts {
  std::uint16_t lostBytes = 0;       ///< bytes that the serial port received but did not store
  std::uint16_t damaged = 0;         ///< frames with bad COBS, a bad CRC or a body of fewer than 5
                                     ///< bytes
  std::uint16_t tooLong = 0;         ///< frames with a body of more than 205 bytes
  std::uint16_t unknownVersion = 0;  ///< frames of another protocol version, except Hello
  std::uint16_t unknownType = 0;     ///< received frames of an unknown type
  std::uint16_t wrongLength = 0;     ///< frames with a payload that is too short
  std::uint16_t outOfRange = 0;      ///< orders with a field out of range
  std::uint16_t unexpected = 0;      ///< frames that the state of the connection did not expect
  std::uint16_t sequenceGaps = 0;    ///< accepted frames whose sequence number is not the successor
                                     ///< of the newest accepted number; a Hello does not count
  std::uint16_t reportsNotSent = 0;  ///< reports for which the serial port had no space
  std::uint16_t staleOrders = 0;     ///< orders that were repeated, or overtaken by a newer frame

  /// @brief Returns whether two sets of counts are equal.
  friend constexpr bool operator==(const LinkCounts&, const LinkCounts&) = default;
};

/// @brief Times of control cycles, counted in processor cycles. All values are 0 if the platform
/// does not count processor cycles.
/// @datatype
struct CycleCosts {
  std::uint32_t report = 0;  ///< processor cycles from the previous clock pulse until the report of
                             ///< the same control cycle was sent
  std::uint32_t awake = 0;   ///< processor cycles without sleep between the last two clock pulses
  std::uint32_t start = 0;   ///< processor cycles from the present clock pulse until the firmware
                             ///< began the control cycle

  /// @brief Returns whether all values of two objects are equal.
  friend constexpr bool operator==(const CycleCosts&, const CycleCosts&) = default;
};

/// @brief Values of one control cycle that a report contains.
/// @datatype
struct ReportData {
  /// @brief Value of `source` until the first order is read.
  static constexpr std::uint8_t kNoSource = 255;

  std::uint32_t cycle = 0;          ///< number of the cycle; the first cycle has the number 1
  Instant time{};                   ///< time of the clock pulse; the PC receives this time in ms
  std::uint8_t operationState = 0;  ///< number of the operation state: OperationStateId
  std::uint8_t readingMode = 0;     ///< number of the reading mode: ModeId
  std::uint8_t source = kNoSource;  ///< mode id of the source of the set-points; 255: none
  std::uint8_t stopSources = 0;     ///< bit n: the source with mode id n orders a stop
  bool orderRead = false;           ///< an order was read in this cycle
  bool held = false;                ///< the wheels are halted and the steering is held
  bool overran = false;             ///< this cycle overran
  SetPoints setPoints{};            ///< set-points in force
  Measurements measurements{};      ///< measured values
  Outputs outputs{};                ///< applied values
  std::uint16_t overruns = 0;       ///< number of cycles that overran, at most 65535
  LinkCounts link{};                ///< errors on the PC link
  CycleCosts costs{};               ///< times of control cycles, in processor cycles

  /// @brief Returns whether two reports have the same values.
  friend constexpr bool operator==(const ReportData&, const ReportData&) = default;
};

}  // namespace wr
