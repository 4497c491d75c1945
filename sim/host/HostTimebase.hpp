#pragma once

#include <cstdint>

#include "devices/Timebase.hpp"
#include "units/quantities.hpp"

namespace wr::host {

/// @brief A timebase whose time advances only when advance() is called.
class HostTimebase final : public Timebase {
 public:
  [[nodiscard]] Instant now() const override { return now_; }
  [[nodiscard]] std::uint32_t awakeCycles() const override { return 0; }

  /// @brief Advances the time.
  void advance(Microseconds duration) { now_ = now_ + duration; }

 private:
  Instant now_{0};
};

}  // namespace wr::host
