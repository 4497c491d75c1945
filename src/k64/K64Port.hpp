#pragma once

#include <cstdint>

#include "devices/EdgeInput.hpp"
#include "k64/pins.hpp"

namespace wr {

/// @brief A pin of the K64 that is read.
/// @function Reads the level of one pin, and causes interrupts at both its edges, up to a limit in
/// each tick.
/// @secret How the ports detect edges, how one flag is cleared without the others, and how the
/// interrupts of an input with too many edges are stopped.
class K64Port final : public EdgeInput {
 public:
  /// @brief Greatest number of interrupts of one input in one tick. A wheel at 600 rpm and a pulse
  /// of the remote control have at most one edge in a tick at each input: the bound allows for a
  /// glitch.
  /// With noise at all inputs the handlers of the edges use about a quarter of the time of the
  /// core.
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

  /// @brief Checks whether an edge is not acknowledged yet.
  /// @return true when acknowledge() would return true
  /// @satisfies FR-200
  /// @isr{yes}
  [[nodiscard]] bool hasEdge() const;

  /// @brief Clears the count of edges, and enables the interrupts again if the input reached its
  /// bound.
  /// @pre It is called once in each tick.
  /// @satisfies FR-201
  /// @isr{yes}
  void allowEdges();

 private:
  Port port_;
  std::uint8_t number_;
  std::uint8_t edges_ = 0;  // edges since the last tick
};

}  // namespace wr
