#pragma once

#include <optional>

#include "sensing/instants/InstantCollector.hpp"

namespace wr {

/// @brief The collector that every other extends.
/// @function Records the time of the last edge.
/// @secret That of all edges only the last is kept.
/// @role{instant-collectors, Concrete Component}
class BasicCollector final : public InstantCollector {
 public:
  /// @brief Constructs a collector without an edge.
  BasicCollector() = default;

  /// @brief Keeps the instant of the edge.
  /// @param edge the edge
  /// @isr{yes}
  /// @satisfies FR-120
  void collect(const Edge& edge) override;

  /// @brief Adds to the record the time of the last edge.
  /// @param instants takes `last`; nothing before the first edge
  /// @isr{yes}
  /// @satisfies FR-120
  void fill(Instants& instants) const override;

 private:
  std::optional<Instant> last_;
};

}  // namespace wr
