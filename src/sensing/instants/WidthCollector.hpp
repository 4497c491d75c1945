#pragma once

#include <optional>

#include "sensing/instants/CollectorDecorator.hpp"

namespace wr {

/// @brief Adds the width of a pulse.
/// @function Measures the width of the last pulse.
/// @secret The condition for a rising and a falling edge to form one pulse.
/// @role{instant-collectors, Concrete Decorator}
class WidthCollector final : public CollectorDecorator {
 public:
  /// @brief Extends a collector.
  /// @param wrapped the extended collector
  explicit WidthCollector(InstantCollector& wrapped);

  /// @brief Forwards the edge; a rising edge begins a pulse, and the next falling edge ends it. A
  /// falling edge without a rising edge before it ends no pulse, and the width is then unknown.
  /// @param edge the edge
  /// @isr{yes}
  /// @satisfies FR-52
  void collect(const Edge& edge) override;

  /// @brief Adds the width to the record of the wrapped collector.
  /// @param instants receives `width` [us]; unchanged without a complete pulse
  /// @isr{yes}
  /// @satisfies FR-52
  void fill(Instants& instants) const override;

 private:
  std::optional<Instant> rise_;  // beginning of the pulse that has not ended
  std::optional<Microseconds> width_;
};

}  // namespace wr
