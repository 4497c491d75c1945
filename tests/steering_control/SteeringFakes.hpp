#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "devices/DigitalOutput.hpp"
#include "devices/EdgeInput.hpp"

namespace wr::test {

/// @brief An output that stores its level. The output calls its listener at each change from off to
/// on.
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

/// @brief The switch of an end stop: a contact to ground that opens when the end stop is reached.
class FakeEnd final : public EdgeInput {
 public:
  void start() override {}
  [[nodiscard]] bool level() const override { return reached || broken; }
  [[nodiscard]] bool acknowledge() override { return false; }

  bool reached = false;
  bool broken = false;  // true: the wire is broken
};

}  // namespace wr::test
