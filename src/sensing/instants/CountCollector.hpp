#pragma once

#include <cstdint>

#include "sensing/instants/CollectorDecorator.hpp"

namespace wr {

/// @brief A collector that adds the number of edges to the record.
/// @function Counts up at each forward edge, and down at each backward edge.
/// @secret The rule by which edges are counted, and the overflow of the count.
/// @role{instant-collectors, Concrete Decorator}
class CountCollector final : public CollectorDecorator {
 public:
  /// @param wrapped the extended collector
  explicit CountCollector(InstantCollector& wrapped);

  /// @brief Forwards the edge, and adds its direction (1, -1 or 0) to the count. After its highest
  /// value the count continues with its lowest value. Therefore the difference of two counts stays
  /// correct.
  /// @param edge the edge
  /// @isr{yes}
  /// @satisfies FR-121
  void collect(const Edge& edge) override;

  /// @brief Writes the values of the wrapped collector, and then the count.
  /// @param instants receives `count` [edges since start]
  /// @isr{yes}
  /// @satisfies FR-121
  void fill(Instants& instants) const override;

 private:
  std::uint32_t count_ = 0;  // a negative count is stored in two's complement
};

}  // namespace wr
