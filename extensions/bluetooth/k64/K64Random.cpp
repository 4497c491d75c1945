#include "bluetooth/k64/K64Random.hpp"

#include "k64/K64Board.hpp"

namespace wr {

std::optional<std::uint64_t> K64Random::draw() {
  constexpr unsigned kWordBits = 32;
  const std::optional<std::uint32_t> high = K64Board::randomWord();
  const std::optional<std::uint32_t> low = K64Board::randomWord();
  if (!high || !low) {
    return std::nullopt;
  }
  return std::uint64_t{*high} << kWordBits | *low;
}

}  // namespace wr
