#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "units/Measurements.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Supervision of the polarity of one motor: finds swapped leads.
///
/// @function Learns the resistance of the motor, its motor constant and the offset of its current
/// sensor. Detects leads that are swapped after the model was learned: the sign of the induced
/// voltage then changes from one cycle to the next.
///
/// @secret The rule by which the model of a motor is learned, and the rule by which swapped leads
/// are detected.
class LeadsWatch final {
 public:
  /// @brief Constructs the supervision with the model of the nominal motor.
  LeadsWatch();
  LeadsWatch(const LeadsWatch&) = delete;
  LeadsWatch& operator=(const LeadsWatch&) = delete;

  /// @brief Compares the measurements of a cycle with the model, and adapts the model to these
  /// measurements.
  /// @param measured measurements of the cycle that ends
  /// @param tension voltage of the wheel during this cycle [mV]; no value while the driver of the
  /// wheel is off
  /// @return true if the leads of the motor are probably swapped.
  /// @satisfies FR-307
  /// @isr{no}
  [[nodiscard]] bool swapped(const WheelMeasurements& measured, std::optional<Tension> tension);

  /// @brief Sets the model to the nominal motor again, and clears the evidence.
  /// @satisfies FR-307
  /// @isr{no}
  void reset();

 private:
  static constexpr std::size_t kParameters = 3;
  using Vector = std::array<float, kParameters>;

  /// The values of one cycle that change the evidence and the model.
  struct Cycle {
    Vector inputs{};        // [V] winding voltage and induced voltage of the nominal motor, and 1 V
    Vector spread{};        // covariance matrix of the deviations, multiplied by the inputs
    float unexplained = 0;  // voltage that the model does not explain [V]
    float weight = 0;       // 1 divided by the variance of the unexplained voltage [1/V^2]
    bool moved = false;     // the Hall edges confirm the direction of the velocity
  };

  [[nodiscard]] Cycle examine(const WheelMeasurements& measured, Tension tension);
  void weigh(const Cycle& cycle);
  void learn(const Cycle& cycle);

  Vector deviations_{};                       // deviations of the parameters from the nominal motor
  std::array<Vector, kParameters> doubts_{};  // covariance matrix of the deviations
  float evidence_ = 0;                        // evidence that the leads are swapped, a logarithm
  Tension tension_{};                         // voltage of the previous cycle
  Velocity velocity_{};                       // velocity of the previous cycle
  std::optional<HallCount> position_;         // position of the previous cycle
};

}  // namespace wr
