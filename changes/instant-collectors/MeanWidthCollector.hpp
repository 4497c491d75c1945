#pragma once

#include "sensing/instants/CollectorDecorator.hpp"

namespace wr {

/// @brief A collector that smooths the width of pulses: it returns the mean width of the last two
/// pulses.
class MeanWidthCollector final : public CollectorDecorator {
 public:
  /// @param wrapped the extended collector, which measures the width
  explicit MeanWidthCollector(InstantCollector& wrapped) : CollectorDecorator(wrapped) {}

  /// @brief Forwards the edge to the wrapped collector. At a rising edge, also stores the width of
  /// the previous pulse.
  /// @param edge the edge
  /// @isr{yes}
  void collect(const Edge& edge) override {
    if (edge.rising) {
      Instants instants;
      CollectorDecorator::fill(instants);
      before_ = instants.width;
    }
    CollectorDecorator::collect(edge);
  }

  /// @brief Writes the values of the wrapped collector. If there were at least two pulses, replaces
  /// the width by the mean width of the last two pulses.
  /// @param instants receives `width` [us]
  /// @isr{yes}
  void fill(Instants& instants) const override {
    CollectorDecorator::fill(instants);
    if (instants.width && before_) {
      instants.width = (*instants.width + *before_) / 2;
    }
  }

 private:
  std::optional<Microseconds> before_;  // width of the previous pulse
};

}  // namespace wr
