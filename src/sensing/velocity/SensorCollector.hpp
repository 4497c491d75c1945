#pragma once

#include <cstdint>
#include <optional>

#include "sensing/instants/InstantCollector.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief What is known of the Hall edges of a wheel. All numbers count from start: who wants those
/// of a time takes the difference.
/// @datatype
struct HallRecord {
  Instants instants;           ///< what the collector of instants tells
  std::uint16_t rejected = 0;  ///< edges that were rejected since start, at most 65535
};

/// @brief Collects the edges of the two Hall sensors of a wheel.
/// @function Finds the direction of each edge and gives it to a collector of instants. Rejects and
/// counts edges that a wheel cannot give. Hands the whole record from the interrupt to the thread
/// of the wheel.
/// @secret The sequence of levels that a turning wheel gives, and which edges are not believed.
/// @role{hall-interrupt, Receiver}
class SensorCollector final {
 public:
  /// @brief Velocity that no wheel reaches: half more than the greatest that can be ordered.
  static constexpr Velocity kGreatestVelocity{4500};

  /// @brief Binds the collector of instants.
  /// @param instants takes the edges that are believed
  explicit SensorCollector(InstantCollector& instants);

  SensorCollector(const SensorCollector&) = delete;
  SensorCollector& operator=(const SensorCollector&) = delete;

  /// @brief Takes the levels after an edge. The first call only learns where the wheel stands. An
  /// edge is rejected and counted when no level changed, when both changed, and when it follows an
  /// edge of the same direction sooner than a wheel at 450 rpm can give it. An edge that turns the
  /// direction may follow at any time: a wheel can rock on an edge.
  /// @param phase levels of the sensors, bit 0 the first, bit 1 the second [0 to 3]; forwards they
  /// are 0, 1, 3, 2
  /// @param at time of the edge
  /// @isr{yes}
  /// @satisfies FR-121
  /// @satisfies FR-123
  void collect(std::uint8_t phase, Instant at);

  /// @brief Tells all that is known of the edges, as of the last one.
  /// @return the record; empty before the first edge
  /// @pre No other call of record() is under way: only the thread of the wheel calls it.
  /// @isr{no}
  /// @satisfies FR-120
  [[nodiscard]] HallRecord record();

 private:
  /// @brief Tells whether an edge is believed.
  [[nodiscard]] bool plausible(std::int8_t direction, Instant at) const;

  InstantCollector& instants_;
  std::optional<std::uint8_t> phase_;
  std::int8_t direction_ = 0;  // of the last edge that was believed
  Instant last_{};             // its time
  HallRecord newest_;
  Pipe<HallRecord> record_;
};

}  // namespace wr
