#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "safety/LeadsWatch.hpp"
#include "units/Measurements.hpp"
#include "units/SetPoints.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Plausibility checks of one wheel.
///
/// @function Once per cycle, compares the measurements of a wheel with its voltage, its set-point
/// and the model of its motor. Returns the cause of a protective stop when a measurement is
/// implausible.
///
/// @secret The measurements of a wheel that are implausible, and the time for which implausible
/// measurements are tolerated.
class WheelSupervision final {
 public:
  /// @brief Constructs the supervision without measurements.
  WheelSupervision() = default;
  WheelSupervision(const WheelSupervision&) = delete;
  WheelSupervision& operator=(const WheelSupervision&) = delete;

  /// @brief Checks whether the measurements of a cycle are plausible.
  /// @param measured measurements of the cycle that ends
  /// @param applied voltage that the wheel has in the next cycle [mV]; no value while the driver of
  /// the wheel is off
  /// @param followed set-point that the wheel follows in the next cycle; nullptr while the wheel is
  /// halted
  /// @return cause of a protective stop; StopCause::None if the measurements are plausible.
  /// @satisfies FR-273
  /// @satisfies FR-274
  /// @satisfies FR-275
  /// @satisfies FR-276
  /// @satisfies FR-277
  /// @satisfies FR-278
  /// @satisfies FR-279
  /// @satisfies FR-307
  /// @isr{no}
  [[nodiscard]] StopCause examine(const WheelMeasurements& measured, std::optional<Tension> applied,
                                  const WheelSetPoint* followed);

  /// @brief Clears all records of earlier cycles.
  /// @satisfies FR-291
  /// @isr{no}
  void reset();

 private:
  static constexpr std::size_t kReferences = 10;  // number of stored set-points

  // The voltage of a wheel and its three parts: the voltage that the velocity induces, the voltage
  // that the current causes in the winding, and the rest. If the voltage or a measurement is
  // missing, all values are 0. Then the checks of these values find no fault.
  struct Balance {
    Velocity velocity{};
    Tension tension{};
    Tension induced{};
    Tension winding{};
    Tension residual{};  // the rest of the voltage
  };

  [[nodiscard]] Balance balanceOf(Velocity velocity, Current current) const;
  [[nodiscard]] static bool opposes(const Balance& balance);
  [[nodiscard]] bool exceedsReference(Velocity velocity) const;
  [[nodiscard]] static bool deviates(const Balance& balance);
  [[nodiscard]] bool rejectsEdges(const WheelMeasurements& measured);
  [[nodiscard]] bool staysEqual(std::optional<Current> current);
  void record(std::optional<Tension> applied, const WheelSetPoint* followed);

  std::optional<Tension> tension_;         // voltage during the cycle that ends
  std::optional<std::uint32_t> rejected_;  // number of implausible Hall edges up to the last cycle
  Velocity velocity_{};                    // velocity of the previous cycle
  std::optional<Current> current_;         // current of the previous cycle
  std::uint8_t equalCycles_ = 0;
  // Magnitudes of the last set-points of velocity.
  std::array<std::optional<Velocity>, kReferences> references_{};
  std::size_t oldest_ = 0;  // index of the oldest set-point, which the next set-point replaces
  bool following_ = false;
  std::uint8_t opposing_ = 0;  // [half cycle] unit of this count and of the next three counts
  std::uint8_t tooFast_ = 0;
  std::uint8_t deviating_ = 0;
  std::uint8_t missing_ = 0;
  std::uint8_t rejecting_ = 0;  // [half edge] count of implausible edges
  LeadsWatch leads_;
};

}  // namespace wr
