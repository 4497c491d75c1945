#pragma once

#include <cstdint>

#include "devices/Timebase.hpp"

namespace wr::test {

/// @brief A clock that only the test advances.
class FakeTimebase final : public Timebase {
 public:
  [[nodiscard]] Instant now() const override { return now_; }
  [[nodiscard]] std::uint32_t awakeCycles() const override { return cycles_; }

  void advance(Microseconds duration) { now_ = now_ + duration; }
  void work(std::uint32_t cycles) { cycles_ += cycles; }

 private:
  Instant now_{};
  std::uint32_t cycles_ = 0;
};

}  // namespace wr::test
