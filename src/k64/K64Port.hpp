#pragma once

#include <cstdint>

#include "devices/EdgeInput.hpp"
#include "k64/pins.hpp"

namespace wr {

/// @brief A pin of the K64 that is read.
/// @function Tells the level of one pin, and interrupts at both its edges.
/// @secret How the ports find edges, and how one flag is cleared and the others are left.
class K64Port final : public EdgeInput {
 public:
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

 private:
  Port port_;
  std::uint8_t number_;
};

}  // namespace wr
