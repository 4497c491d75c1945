#include "bluetooth/k64/K64Random.hpp"

#include "k64/registers.hpp"

namespace wr {

namespace {

// A word takes 256 clocks of the bus, and a look more than 4.
constexpr std::uint32_t kLooks = 2'000;
constexpr unsigned kWordBits = 32;

std::optional<std::uint32_t> word() {
  for (std::uint32_t look = 0; look < kLooks; ++look) {
    if ((rng::SR.read() & rng::SR_OREG_LVL).any()) {
      return rng::OR.read().value;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::uint64_t> K64Random::draw() {
  rng::CR.write(rng::CR_GO | rng::CR_HA | rng::CR_INTM);
  const std::optional<std::uint32_t> high = word();
  const std::optional<std::uint32_t> low = word();
  if (!high || !low) {
    return std::nullopt;
  }
  return std::uint64_t{*high} << kWordBits | *low;
}

}  // namespace wr
