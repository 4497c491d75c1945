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
/// @function Counts the Hall edges of each wheel until the robot has driven 0.057 m, then compares
/// the counts. The mean distance is the mean of the two middle distances of the four wheels. Finds
/// a wheel whose distance was at most half of the mean distance in each of two successive
/// comparisons. Finds a wheel whose current is too high for too long.
///
/// @secret The permitted difference between the wheels of one robot, and the distance and the time
/// of a comparison.
class WheelComparison final {
 public:
  /// @brief Constructs the comparison without measurements.
  WheelComparison() = default;
  WheelComparison(const WheelComparison&) = delete;
  WheelComparison& operator=(const WheelComparison&) = delete;

  /// @brief Compares the distances of the wheels. This function is called once in each cycle in
  /// which the wheels follow set-points.
  /// @param measurements measurements of the cycle that ends
  /// @return number of a wheel that moved too little in two successive comparisons, 0 to 3; no
  /// value if there is no such wheel.
  /// @satisfies FR-297
  /// @isr{no}
  [[nodiscard]] std::optional<std::uint8_t> behind(const Measurements& measurements);

  /// @brief Checks whether the current of a wheel was too high for too long. This function is
  /// called once in each cycle in which the wheels follow set-points.
  /// @param measurements measurements of the cycle that ends
  /// @return number of a wheel whose current was too high for too long, 0 to 3; no value if there
  /// is no such wheel.
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
  std::array<std::int32_t, kWheelCount> ways_{};  // [edges] distances in this comparison
  // For each wheel: count of successive cycles with a high current. A cycle with a small steering
  // angle counts more than a cycle with a large angle.
  std::array<std::uint8_t, kWheelCount> greatCycles_{};
  std::array<bool, kWheelCount> late_{};  // wheels that moved too little at the last comparison
};

}  // namespace wr
