#pragma once

#include <cstdint>
#include <optional>

#include "devices/AnalogInput.hpp"

namespace wr::test {

/// @brief Input whose conversions end when the test says so.
class FakeAnalogInput final : public AnalogInput {
 public:
  void convert() override { ++conversions; }

  [[nodiscard]] std::optional<std::uint16_t> take() override {
    const std::optional<std::uint16_t> taken = result;
    result.reset();
    return taken;
  }

  std::optional<std::uint16_t> result;
  int conversions = 0;
};

}  // namespace wr::test
