#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "units/Measurements.hpp"
#include "units/SetPoints.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Comparison of the wheels of one robot.
///
/// @function Adds the Hall edges of each wheel until the robot has driven 0.057 m. Returns a wheel
/// that moved at most half as far as the other wheels in two successive comparisons. Returns a
/// wheel that has a great current although the robot drives straight on.
///
/// @secret How far the wheels of one robot can differ, and the distance and the time of a
/// comparison.
class WheelComparison final {
 public:
  /// @brief Begins without measurements.
  WheelComparison() = default;
  WheelComparison(const WheelComparison&) = delete;
  WheelComparison& operator=(const WheelComparison&) = delete;

  /// @brief Compares the wheels. Each cycle in which the wheels follow set-points calls this
  /// function.
  /// @param measurements measurements of the cycle that ends
  /// @return number of the wheel that moved too little, 0 to 3; nothing if there is none.
  /// @satisfies FR-297
  /// @isr{no}
  [[nodiscard]] std::optional<std::uint8_t> behind(const Measurements& measurements);

  /// @brief Checks the currents of a robot that drives straight on. Each cycle in which the wheels follow
  /// set-points calls this function.
  /// @param measurements measurements of the cycle that ends
  /// @return number of a wheel whose current was too great for too long, 0 to 3; nothing if there is none.
  /// @satisfies FR-298
  /// @isr{no}
  [[nodiscard]] std::optional<std::uint8_t> overloaded(const Measurements& measurements);

  /// @brief Clears all records.
  /// @satisfies FR-297
  /// @satisfies FR-298
  /// @isr{no}
  void reset();

 private:
  void add(const Measurements& measurements);
  [[nodiscard]] std::int32_t common() const;

  std::array<std::optional<HallCount>, kWheelCount> before_{};  // positions of the previous cycle
  std::array<std::int32_t, kWheelCount> ways_{};                // [edges]
  std::array<std::uint8_t, kWheelCount> greatCycles_{};         // successive cycles with a great
                                                                // current
  std::optional<std::uint8_t> late_;  // wheel that moved too little at the last comparison
};

}  // namespace wr
