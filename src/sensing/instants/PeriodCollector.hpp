#pragma once

#include <optional>

#include "sensing/instants/CollectorDecorator.hpp"

namespace wr {

/// @brief A collector that adds the period of the signal to the record.
/// @function Measures the time between the last two rising edges.
/// @secret The edges that begin and end a period.
/// @role{instant-collectors, Concrete Decorator}
class PeriodCollector final : public CollectorDecorator {
 public:
  /// @param wrapped the extended collector
  explicit PeriodCollector(InstantCollector& wrapped);

  /// @brief Forwards the edge. A rising edge ends a period and begins the next period.
  /// @param edge the edge
  /// @isr{yes}
  /// @satisfies FR-55
  void collect(const Edge& edge) override;

  /// @brief Writes the values of the wrapped collector, and then the period.
  /// @param instants receives `period` [us], which is empty before the second rising edge
  /// @isr{yes}
  /// @satisfies FR-55
  void fill(Instants& instants) const override;

 private:
  std::optional<Instant> rise_;
  std::optional<Microseconds> period_;
};

}  // namespace wr
