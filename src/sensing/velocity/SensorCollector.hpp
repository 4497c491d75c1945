#pragma once

#include <cstdint>
#include <optional>

#include "sensing/instants/InstantCollector.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Record of the Hall edges of a wheel. A step is an edge at which exactly one of the two
/// levels changed. All numbers are counted from start and can overflow.
/// A reader subtracts two records to get the edges between them.
/// @datatype
struct HallRecord {
  Instants instants;            ///< times and number of the steps
  std::uint32_t unclear = 0;    ///< number of interrupts in which no level or both levels changed
  std::uint32_t reversals = 0;  ///< number of steps that reversed the direction faster than a
                                ///< turning wheel can
};

/// @brief A collector of the edges of the two Hall sensors of a wheel.
/// @function Determines the direction of each edge, and passes edge and direction to a collector of
/// instants. Counts separately the edges that a turning wheel cannot cause. Passes the whole record
/// from the interrupt to the thread of the wheel.
/// @secret The sequence of levels of a turning wheel, and the definition of an implausible edge.
/// @role{hall-interrupt, Receiver}
class SensorCollector final {
 public:
  /// @param instants receives each step, that is, each edge at which exactly one level changed
  explicit SensorCollector(InstantCollector& instants);

  SensorCollector(const SensorCollector&) = delete;
  SensorCollector& operator=(const SensorCollector&) = delete;

  /// @brief Records the levels after an edge, and counts the edge. The first call only records the
  /// levels. If exactly one level changed, the edge is counted as a step. The time since the
  /// previous edge does not matter. If no level or both levels changed, the edge is counted as
  /// unclear. If a step reverses the direction less than 25 ms after the previous step, it is also
  /// counted as a reversal. A turning wheel cannot cause a reversal, but a wheel that rests on an
  /// edge can.
  /// @param phase levels of the sensors [0 to 3]; bit 0 is the level of the first sensor, and bit 1
  /// is the level of the second sensor. While a wheel turns forwards, the sequence is 0, 1, 3, 2.
  /// @param at time of the edge
  /// @isr{yes}
  /// @satisfies FR-121
  /// @satisfies FR-123
  /// @satisfies FR-220
  void collect(std::uint8_t phase, Instant at);

  /// @brief Returns the record of the edges, up to the last edge.
  /// @return the record, which does not change before the next call; it is empty before the first
  /// edge
  /// @pre Only the thread of the wheel calls this function.
  /// @isr{no}
  /// @satisfies FR-120
  [[nodiscard]] const HallRecord& record();

 private:
  /// @brief Records a step, and counts a reversal if the direction changed too soon.
  void step(std::int8_t direction, bool rising, Instant at);

  InstantCollector& instants_;
  std::optional<std::uint8_t> phase_;
  std::int8_t direction_ = 0;  // direction of the last step
  Instant last_{};             // time of the last step
  HallRecord newest_;
  Pipe<HallRecord> record_;
};

}  // namespace wr
