#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <random>
#include <string>

namespace wr::test {

/// @brief Returns the seed of a random test. The seed is printed and written to the results. The
/// environment variable WR_SEED sets the seed.
inline unsigned seed() {
  const char* const given = std::getenv("WR_SEED");
  const unsigned value =
      given != nullptr ? static_cast<unsigned>(std::stoul(given)) : std::random_device()();
  std::cout << "WR_SEED=" << value << "\n";
  testing::Test::RecordProperty("seed", std::to_string(value));
  return value;
}

}  // namespace wr::test
