#pragma once

#include "devices/Timebase.hpp"

namespace wr::test {

/// @brief Clock that stands still until the test moves it.
class FakeTimebase final : public Timebase {
 public:
  [[nodiscard]] Instant now() const override { return now_; }

  void advance(Microseconds duration) { now_ = now_ + duration; }

 private:
  Instant now_{};
};

}  // namespace wr::test
