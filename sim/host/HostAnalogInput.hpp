#pragma once

#include <cstdint>
#include <optional>

#include "devices/AnalogInput.hpp"

namespace wr::host {

/// @brief An analog input on the host. A conversion takes no time.
class HostAnalogInput final : public AnalogInput {
 public:
  HostAnalogInput() = default;

  [[nodiscard]] std::optional<std::uint16_t> sample() override;

  /// @brief Puts a voltage on the input; half of the range at first.
  /// @param share fraction of the range; a value beyond 0 to 1 counts as the limit
  void drive(double share);

 private:
  std::uint16_t level_ = kFullScale / 2 + 1;
  std::optional<std::uint16_t> result_;
};

}  // namespace wr::host
