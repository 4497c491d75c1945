#pragma once

#include <cstdint>

#include "devices/EdgeInput.hpp"
#include "k64/pins.hpp"

namespace wr {

/// @brief Input pin of the K64.
/// @function Reads the level of one pin. Causes an interrupt at each rising and each falling edge,
/// up to a limit in each tick.
/// @secret The method by which edges are detected. The method by which the flag of one pin is
/// cleared without a change of the flags of other pins. The method by which the interrupts of an
/// input with too many edges are blocked.
class K64Port final : public EdgeInput {
 public:
  /// @brief Greatest number of interrupts of one input in one tick. Without noise an input has at
  /// most one edge in a tick, even when a wheel turns at 600 rpm. The limit also permits three
  /// false edges. If all inputs have noise, the handlers of the edges use about a quarter of the
  /// time of the core.
  static constexpr std::uint8_t kMaxEdges = 4;

  /// @param pin an input of the pin table
  explicit constexpr K64Port(const Pin& pin) : port_(pin.port), number_(pin.number) {}

  /// @pre K64Board::connectInputs() was called.
  /// @isr{no}
  /// @satisfies FR-144
  void start() override;

  /// @satisfies FR-144
  /// @isr{yes}
  [[nodiscard]] bool level() const override;

  /// @satisfies FR-144
  /// @isr{yes}
  [[nodiscard]] bool acknowledge() override;

  /// @brief Returns whether an edge has occurred and is not acknowledged yet.
  /// @return true when acknowledge() would return true
  /// @satisfies FR-200
  /// @isr{yes}
  [[nodiscard]] bool hasEdge() const;

  /// @brief Clears the number of edges in this tick. If this number had reached kMaxEdges, enables
  /// the interrupts of the input again.
  /// @pre The function is called once in each tick.
  /// @satisfies FR-201
  /// @isr{yes}
  void allowEdges();

 private:
  Port port_;
  std::uint8_t number_;
  std::uint8_t edges_ = 0;  // edges since the last tick
};

}  // namespace wr
