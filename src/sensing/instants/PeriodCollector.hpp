#pragma once

#include <optional>

#include "sensing/instants/CollectorDecorator.hpp"

namespace wr {

/// @brief Adds the period of the signal.
/// @function Measures the time between the two last rising edges.
/// @secret Between which edges a period is taken.
/// @role{instant-collectors, Concrete Decorator}
class PeriodCollector final : public CollectorDecorator {
 public:
  /// @brief Extends a collector.
  /// @param wrapped the extended collector
  explicit PeriodCollector(InstantCollector& wrapped);

  /// @brief Passes the edge on; a rising one ends a period and begins the next.
  /// @param edge the edge
  /// @isr{yes}
  /// @satisfies FR-55
  void collect(const Edge& edge) override;

  /// @brief Adds to the record of the wrapped collector the period.
  /// @param instants takes `period` [us]; nothing before the second rising edge
  /// @isr{yes}
  /// @satisfies FR-55
  void fill(Instants& instants) const override;

 private:
  std::optional<Instant> rise_;
  std::optional<Microseconds> period_;
};

}  // namespace wr
