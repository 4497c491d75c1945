#pragma once

#include <cstdlib>
#include <iostream>
#include <random>
#include <string>

namespace wr::test {

/// @brief Seed of a random test. It is printed; the variable WR_SEED sets it.
inline unsigned seed() {
  const char* const given = std::getenv("WR_SEED");
  const unsigned value =
      given != nullptr ? static_cast<unsigned>(std::stoul(given)) : std::random_device()();
  std::cout << "WR_SEED=" << value << "\n";
  return value;
}

}  // namespace wr::test
