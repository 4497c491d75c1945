#pragma once

#include "devices/EdgeInput.hpp"

namespace wr::test {

/// @brief An edge input. A test sets its level.
class FakeEdgeInput final : public EdgeInput {
 public:
  void start() override { started = true; }
  [[nodiscard]] bool level() const override { return high; }

  [[nodiscard]] bool acknowledge() override {
    const bool edge = pending;
    pending = false;
    return edge;
  }

  /// @brief Sets the level. If the level changes, an edge is pending until acknowledge() is called.
  void set(bool level) {
    pending = pending || level != high;
    high = level;
  }

  bool started = false;
  bool high = false;
  bool pending = false;
};

}  // namespace wr::test
