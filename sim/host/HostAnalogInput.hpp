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

  /// @brief Puts a voltage on the input. The initial voltage is half of the range.
  /// @param share fraction of the range; a value below 0 counts as 0, and a value above 1 counts as
  /// 1
  void drive(double share);

  /// @brief Stops the converter: no further conversion ends.
  void stop() { converts_ = false; }

 private:
  bool converts_ = true;
  std::uint16_t level_ = kFullScale / 2 + 1;
  std::optional<std::uint16_t> result_;
};

}  // namespace wr::host
