#pragma once

#include <cstdint>
#include <limits>

#include "devices/Timebase.hpp"
#include "k64/core.hpp"
#include "ports/mps2/registers.hpp"

namespace wr::mps2 {

/// @brief A timebase that reads the first counter of the dual timer. This counter counts down
/// without end.
class CmsdkTimebase final : public Timebase {
 public:
  constexpr CmsdkTimebase() = default;

  /// @brief Starts the counter.
  /// @isr{no}
  void start() {
    dual_timer::CONTROL.write({0});
    last_ = dual_timer::VALUE.read().value;
    dual_timer::CONTROL.write(dual_timer::CONTROL_32_BITS | dual_timer::CONTROL_ENABLE);
    last_ = dual_timer::VALUE.read().value;
  }

  /// @pre The last call was less than 171 s ago. After a longer time the counter can have
  /// overflowed twice. Each control cycle calls this function.
  [[nodiscard]] Instant now() const override {
    const InterruptLock lock;
    const std::uint32_t count = dual_timer::VALUE.read().value;
    ticks_ += last_ - count;
    last_ = count;
    return Instant(ticks_ / kTicksPerMicrosecond);
  }

  /// @return always 0, because the board does not count the cycles of its processor
  [[nodiscard]] std::uint32_t awakeCycles() const override { return 0; }

 private:
  mutable std::uint64_t ticks_ = 0;
  mutable std::uint32_t last_ = std::numeric_limits<std::uint32_t>::max();
};

}  // namespace wr::mps2
