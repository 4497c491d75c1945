#pragma once

#include <cstdint>
#include <optional>

#include "devices/AnalogInput.hpp"
#include "devices/DigitalOutput.hpp"
#include "devices/EdgeInput.hpp"
#include "devices/PwmOutput.hpp"

// The board has no motors, no sensors and no remote control. The devices below are used in their
// place.

namespace wr::mps2 {

/// @brief An output without a connection.
class NoOutput final : public DigitalOutput {
 public:
  constexpr NoOutput() = default;
  void set(bool /*on*/) override {}
};

/// @brief A voltage output without a connection.
class NoPwm final : public PwmOutput {
 public:
  constexpr NoPwm() = default;
  void set(DutyCycle /*dutyCycle*/) override {}
};

/// @brief An input that is always low.
class NoEdges final : public EdgeInput {
 public:
  constexpr NoEdges() = default;
  void start() override {}
  [[nodiscard]] bool level() const override { return false; }
  [[nodiscard]] bool acknowledge() override { return false; }
};

/// @brief A converter that never has a sample.
class NoVoltage final : public AnalogInput {
 public:
  constexpr NoVoltage() = default;
  [[nodiscard]] std::optional<std::uint16_t> sample() override { return std::nullopt; }
};

}  // namespace wr::mps2
