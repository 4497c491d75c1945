#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "devices/DigitalOutput.hpp"
#include "devices/EdgeInput.hpp"

namespace wr::test {

/// @brief Output that keeps its level, and calls back at each change to on.
class FakeOutput final : public DigitalOutput {
 public:
  void set(bool level) override {
    const bool rises = level && !on;
    on = level;
    if (rises) {
      onRise();
    }
  }

  bool on = false;
  std::function<void()> onRise = [] {};
};

/// @brief Switch of an end stop: a contact to ground that opens when the end stop is reached.
class FakeEnd final : public EdgeInput {
 public:
  void start() override {}
  [[nodiscard]] bool level() const override { return reached || broken; }
  [[nodiscard]] bool acknowledge() override { return false; }

  bool reached = false;
  bool broken = false;  // the wire
};

}  // namespace wr::test
