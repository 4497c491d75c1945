#pragma once

#include "devices/EdgeInput.hpp"

namespace wr::test {

/// @brief An edge input. The test sets its level.
class FakeEdgeInput final : public EdgeInput {
 public:
  void start() override { started = true; }
  [[nodiscard]] bool level() const override { return high; }

  [[nodiscard]] bool acknowledge() override {
    const bool edge = pending;
    pending = false;
    return edge;
  }

  /// @brief Changes the level. The edge then waits for an acknowledgement.
  void set(bool level) {
    pending = pending || level != high;
    high = level;
  }

  bool started = false;
  bool high = false;
  bool pending = false;
};

}  // namespace wr::test
