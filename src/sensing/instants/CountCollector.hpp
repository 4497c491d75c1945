#pragma once

#include <cstdint>

#include "sensing/instants/CollectorDecorator.hpp"

namespace wr {

/// @brief Adds the number of edges.
/// @function Counts the forward edges minus the backward edges.
/// @secret How edges are counted, and the overflow of the count.
/// @role{instant-collectors, Concrete Decorator}
class CountCollector final : public CollectorDecorator {
 public:
  /// @brief Extends a collector.
  /// @param wrapped the extended collector
  explicit CountCollector(InstantCollector& wrapped);

  /// @brief Forwards the edge and adds its direction to the count. The count overflows from its
  /// greatest number to its least, so that differences stay correct.
  /// @param edge the edge
  /// @isr{yes}
  /// @satisfies FR-121
  void collect(const Edge& edge) override;

  /// @brief Adds the count to the record of the wrapped collector.
  /// @param instants receives `count` [edges since start]
  /// @isr{yes}
  /// @satisfies FR-121
  void fill(Instants& instants) const override;

 private:
  std::uint32_t count_ = 0;  // a negative count in two's complement
};

}  // namespace wr
