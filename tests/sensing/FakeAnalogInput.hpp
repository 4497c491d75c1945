#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "devices/AnalogInput.hpp"

namespace wr::test {

/// @brief An analog input. A conversion ends when a test stores the result of this conversion.
class FakeAnalogInput final : public AnalogInput {
 public:
  [[nodiscard]] std::optional<std::uint16_t> sample() override {
    ++conversions;
    return std::exchange(result, std::nullopt);
  }

  std::optional<std::uint16_t> result;
  int conversions = 0;
};

}  // namespace wr::test
