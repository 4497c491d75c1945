#pragma once

#include "sensing/instants/CollectorDecorator.hpp"

namespace wr {

/// @brief Smooths the width of a pulse: returns the mean of the last two pulses.
class MeanWidthCollector final : public CollectorDecorator {
 public:
  /// @brief Extends a collector.
  /// @param wrapped the extended collector, which measures the width
  explicit MeanWidthCollector(InstantCollector& wrapped) : CollectorDecorator(wrapped) {}

  /// @brief Forwards the edge; a rising edge also stores the width of the previous pulse.
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

  /// @brief Writes the record of the wrapped collector; after two pulses the record contains their
  /// mean width.
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
