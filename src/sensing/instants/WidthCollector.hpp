#pragma once

#include <optional>

#include "sensing/instants/CollectorDecorator.hpp"

namespace wr {

/// @brief A collector that adds the width of the last pulse to the record.
/// @function Measures the width of the last pulse.
/// @secret The condition under which a rising and a falling edge form one pulse.
/// @role{instant-collectors, Concrete Decorator}
class WidthCollector final : public CollectorDecorator {
 public:
  /// @param wrapped the extended collector
  explicit WidthCollector(InstantCollector& wrapped);

  /// @brief Forwards the edge. A rising edge begins a pulse, and the next falling edge ends this
  /// pulse. If no rising edge occurred since the previous falling edge, a falling edge ends no
  /// pulse, and the width becomes empty.
  /// @param edge the edge
  /// @isr{yes}
  /// @satisfies FR-52
  void collect(const Edge& edge) override;

  /// @brief Writes the values of the wrapped collector, and then the width.
  /// @param instants receives `width` [us], which is empty if no complete pulse was measured
  /// @isr{yes}
  /// @satisfies FR-52
  void fill(Instants& instants) const override;

 private:
  std::optional<Instant> rise_;  // time at which the present pulse began; empty between pulses
  std::optional<Microseconds> width_;
};

}  // namespace wr
