#pragma once

#include <cstdint>
#include <optional>

#include "units/quantities.hpp"

namespace wr {

/// @brief One edge of a signal.
/// @datatype
struct Edge {
  Instant at{};               ///< time of the edge
  bool rising = false;        ///< the level is high after the edge
  std::int8_t direction = 0;  ///< 1 forwards, -1 backwards; 0 if the signal has no direction
};

/// @brief Record of the edges of a signal. If no collector measures a value, this value is empty.
/// If no collector counts the edges, the count is 0.
/// @datatype
struct Instants {
  std::optional<Instant> last;         ///< time of the last edge
  std::optional<Microseconds> period;  ///< time between the last two rising edges
  std::optional<Microseconds> width;   ///< length of the last pulse, from rising to falling edge
  std::int32_t count = 0;              ///< number of forward edges minus number of backward edges
};

/// @brief A collector of instants, which are the times of the edges of a signal.
/// @function Processes each edge of a signal, and computes values from the edges.
/// @secret The times of edges that are stored, and the values that are computed from these times.
/// @role{instant-collectors, Component}
///
/// @patternapp{instant-collectors, Decorator, Collectors of time instants}
/// @why The signals of the remote control and of the Hall sensors are measured by the times of
/// their edges. The values that are computed from the edges differ between the signals. Each value
/// has its own collector, which extends a basic collector.
/// @changes The calculation of a value may change. A new value needs one more decorator, which
/// wraps only the collectors of the signals that need this value.
class InstantCollector {
 public:
  InstantCollector(const InstantCollector&) = delete;
  InstantCollector& operator=(const InstantCollector&) = delete;

  /// @brief Processes an edge: updates the values of this collector and of the collectors that it
  /// wraps.
  /// @param edge the edge; not earlier than the previous edge
  /// @isr{yes}
  virtual void collect(const Edge& edge) = 0;

  /// @brief Writes the values of this collector and of the collectors that it wraps. Other values
  /// do not change.
  /// @param instants receives the values
  /// @isr{yes}
  virtual void fill(Instants& instants) const = 0;

 protected:
  InstantCollector() = default;
  ~InstantCollector() = default;
};

}  // namespace wr
