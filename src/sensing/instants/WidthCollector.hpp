#pragma once

#include <optional>

#include "sensing/instants/CollectorDecorator.hpp"

namespace wr {

/// @brief Adds the width of a pulse.
/// @function Measures the width of the last pulse.
/// @secret When a rising and a falling edge are the two ends of one pulse.
/// @role{instant-collectors, Concrete Decorator}
class WidthCollector final : public CollectorDecorator {
 public:
  /// @brief Extends a collector.
  /// @param wrapped the extended collector
  explicit WidthCollector(InstantCollector& wrapped);

  /// @brief Passes the edge on; a rising one begins a pulse, the next falling one ends it. A
  /// falling edge without a rising one before it ends no pulse: then no width is known.
  /// @param edge the edge
  /// @isr{yes}
  /// @satisfies FR-52
  void collect(const Edge& edge) override;

  /// @brief Adds to the record of the wrapped collector the width.
  /// @param instants takes `width` [us]; nothing without a whole pulse
  /// @isr{yes}
  /// @satisfies FR-52
  void fill(Instants& instants) const override;

 private:
  std::optional<Instant> rise_;  // of the pulse that has not ended
  std::optional<Microseconds> width_;
};

}  // namespace wr
