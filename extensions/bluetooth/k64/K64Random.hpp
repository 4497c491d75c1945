#pragma once

#include <cstdint>
#include <optional>

#include "bluetooth/RandomSource.hpp"

namespace wr {

/// @brief The random number generator of the K64.
/// @function Draws numbers from the noise that the generator of the microcontroller samples.
/// @secret How many words of the generator make a number.
class K64Random final : public RandomSource {
 public:
  /// @brief Binds nothing: the microcontroller has one generator.
  constexpr K64Random() = default;

  /// @brief Draws a number. The wait is bounded.
  /// @return a number of 64 random bits; nothing when the generator gives none in time
  /// @pre The clock of the generator runs.
  /// @isr{no}
  /// @satisfies FR-264
  [[nodiscard]] std::optional<std::uint64_t> draw() override;
};

}  // namespace wr
