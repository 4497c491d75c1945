#pragma once

#include <optional>

#include "sensing/instants/InstantCollector.hpp"

namespace wr {

/// @brief The collector that all other collectors extend.
/// @function Records the time of the last edge.
/// @secret The choice to store only the last edge.
/// @role{instant-collectors, Concrete Component}
class BasicCollector final : public InstantCollector {
 public:
  /// @brief Constructs a collector without an edge.
  BasicCollector() = default;

  /// @brief Stores the time of the edge.
  /// @param edge the edge
  /// @isr{yes}
  /// @satisfies FR-120
  void collect(const Edge& edge) override;

  /// @brief Adds to the record the time of the last edge.
  /// @param instants receives `last`; unchanged before the first edge
  /// @isr{yes}
  /// @satisfies FR-120
  void fill(Instants& instants) const override;

 private:
  std::optional<Instant> last_;
};

}  // namespace wr
