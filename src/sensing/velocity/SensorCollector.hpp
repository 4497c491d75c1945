#pragma once

#include <cstdint>
#include <optional>

#include "sensing/instants/InstantCollector.hpp"
#include "services/Pipe.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Record of the Hall edges of a wheel. All numbers count from start and can overflow: a
/// reader subtracts two records.
/// @datatype
struct HallRecord {
  Instants instants;            ///< times and number of the steps
  std::uint32_t unclear = 0;    ///< interrupts since start in which no level or both levels changed
  std::uint32_t reversals = 0;  ///< steps since start that reversed faster than a turning wheel can
};

/// @brief Collects the edges of the two Hall sensors of a wheel.
/// @function Determines the direction of each edge and passes it to a collector of instants. Counts
/// separately the edges that a turning wheel cannot cause. Passes the whole record from the
/// interrupt to the thread of the wheel.
/// @secret The sequence of levels of a turning wheel, and which edges are implausible.
/// @role{hall-interrupt, Receiver}
class SensorCollector final {
 public:
  /// @brief Binds the collector of instants.
  /// @param instants receives each step, that is, each edge at which exactly one level changed
  explicit SensorCollector(InstantCollector& instants);

  SensorCollector(const SensorCollector&) = delete;
  SensorCollector& operator=(const SensorCollector&) = delete;

  /// @brief Records the levels after an edge. The first call only records the levels. An edge at
  /// which exactly one level changed is a step and is counted, at any time after the previous edge.
  /// An edge is unclear when no level or both levels changed. A step that reverses the direction
  /// within 25 ms is counted as a step and as a reversal. A turning wheel cannot cause a reversal,
  /// but a wheel at rest on an edge can.
  /// @param phase levels of the sensors, bit 0 the first, bit 1 the second [0 to 3]; a wheel that
  /// turns forwards gives 0, 1, 3, 2
  /// @param at time of the edge
  /// @isr{yes}
  /// @satisfies FR-121
  /// @satisfies FR-123
  /// @satisfies FR-220
  void collect(std::uint8_t phase, Instant at);

  /// @brief Returns the record of the edges, up to the last edge.
  /// @return the record, unchanged until the next call; empty before the first edge
  /// @pre No other call of record() is active: only the thread of the wheel calls this function.
  /// @isr{no}
  /// @satisfies FR-120
  [[nodiscard]] const HallRecord& record();

 private:
  /// @brief Records a step.
  void step(std::int8_t direction, bool rising, Instant at);

  InstantCollector& instants_;
  std::optional<std::uint8_t> phase_;
  std::int8_t direction_ = 0;  // direction of the last step
  Instant last_{};             // time of the last step
  HallRecord newest_;
  Pipe<HallRecord> record_;
};

}  // namespace wr
