#pragma once

#include <cstdint>

#include "sensing/instants/CollectorDecorator.hpp"

namespace wr {

/// @brief Adds the number of edges.
/// @function Counts the edges that came forwards, less those that came backwards.
/// @secret How edges are counted, and what happens when the count reaches its end.
/// @role{instant-collectors, Concrete Decorator}
class CountCollector final : public CollectorDecorator {
 public:
  /// @brief Extends a collector.
  /// @param wrapped the extended collector
  explicit CountCollector(InstantCollector& wrapped);

  /// @brief Passes the edge on and adds its direction to the count. The count wraps from its
  /// greatest number to its least, so that differences stay right.
  /// @param edge the edge
  /// @isr{yes}
  /// @satisfies FR-121
  void collect(const Edge& edge) override;

  /// @brief Adds to the record of the wrapped collector the count.
  /// @param instants takes `count` [edges since start]
  /// @isr{yes}
  /// @satisfies FR-121
  void fill(Instants& instants) const override;

 private:
  std::uint32_t count_ = 0;  // a negative count in two's complement
};

}  // namespace wr
