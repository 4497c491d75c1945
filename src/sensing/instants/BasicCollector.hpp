#pragma once

#include <optional>

#include "sensing/instants/InstantCollector.hpp"

namespace wr {

/// @brief The collector that all other collectors extend.
/// @function Records the time of the last edge.
/// @secret The rule that only the time of the last edge is stored.
/// @role{instant-collectors, Concrete Component}
class BasicCollector final : public InstantCollector {
 public:
  /// @brief Constructs a collector that has recorded no edge.
  BasicCollector() = default;

  /// @brief Stores the time of the edge.
  /// @param edge the edge
  /// @isr{yes}
  /// @satisfies FR-120
  void collect(const Edge& edge) override;

  /// @brief Writes the time of the last edge to the record.
  /// @param instants receives `last`, which is empty before the first edge
  /// @isr{yes}
  /// @satisfies FR-120
  void fill(Instants& instants) const override;

 private:
  std::optional<Instant> last_;
};

}  // namespace wr
