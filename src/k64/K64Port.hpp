#pragma once

#include <cstdint>

#include "devices/EdgeInput.hpp"
#include "k64/pins.hpp"

namespace wr {

/// @brief A pin of the K64 that is read.
/// @function Reads the level of one pin, and interrupts at both its edges, up to a bound.
/// @secret How the ports find edges, how one flag is cleared and the others are left, and how an input
/// with too many edges is kept from interrupting.
class K64Port final : public EdgeInput {
 public:
  /// @brief Edges of one input that interrupt in one tick. A wheel at 600 rpm and a pulse of the
  /// remote control have at most one edge in a tick at each input: this leaves room for a glitch.
  /// With noise at all inputs the handlers of the edges take about a quarter of the core.
  static constexpr std::uint8_t kMaxEdges = 4;

  /// @brief Binds an input to a pin.
  /// @param pin an input of the pin table
  explicit constexpr K64Port(const Pin& pin) : port_(pin.port), number_(pin.number) {}

  /// @pre The pin is connected.
  /// @isr{no}
  /// @satisfies FR-144
  void start() override;

  /// @satisfies FR-144
  /// @isr{yes}
  [[nodiscard]] bool level() const override;

  /// @satisfies FR-144
  /// @isr{yes}
  [[nodiscard]] bool acknowledge() override;

  /// @brief Checks whether an edge waits to be acknowledged.
  /// @return true when acknowledge() would return true
  /// @satisfies FR-200
  /// @isr{yes}
  [[nodiscard]] bool hasEdge() const;

  /// @brief Starts the count of edges again, and the interrupts of an input that reached its bound.
  /// @pre It is called once in each tick.
  /// @satisfies FR-201
  /// @isr{yes}
  void allowEdges();

 private:
  Port port_;
  std::uint8_t number_;
  std::uint8_t edges_ = 0;  // since the last tick
};

}  // namespace wr
