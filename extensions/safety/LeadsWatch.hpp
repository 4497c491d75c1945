#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "units/Measurements.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Supervision of the polarity of one motor.
///
/// @function Learns the resistance, the constant and the offset of a motor while it turns. Detects
/// leads that are swapped later: the induced voltage then changes its sign in one cycle.
///
/// @secret How the model of a motor is learned, and how strongly the measurements must contradict
/// the model.
class LeadsWatch final {
 public:
  /// @brief Begins with the nominal motor.
  LeadsWatch();
  LeadsWatch(const LeadsWatch&) = delete;
  LeadsWatch& operator=(const LeadsWatch&) = delete;

  /// @brief Compares the measurements of a cycle with the model, and learns from them.
  /// @param measured measurements of the cycle that ends
  /// @param tension voltage of the wheel during this cycle [mV]; nothing while its driver is off
  /// @return whether the leads of the motor are swapped.
  /// @satisfies FR-307
  /// @isr{no}
  [[nodiscard]] bool swapped(const WheelMeasurements& measured, std::optional<Tension> tension);

  /// @brief Begins again with the nominal motor.
  /// @satisfies FR-307
  /// @isr{no}
  void reset();

 private:
  static constexpr std::size_t kParameters = 3;
  using Vector = std::array<float, kParameters>;

  /// The evidence of one cycle.
  struct Cycle {
    Vector inputs{};        // voltages of the nominal motor, and 1 V [V]
    Vector spread{};        // covariance of the parameters times the inputs
    float unexplained = 0;  // voltage that the model does not explain [V]
    float weight = 0;       // 1 divided by the variance of this voltage [1/V^2]
    bool moved = false;     // the Hall edges show the direction of the velocity
  };

  [[nodiscard]] Cycle examine(const WheelMeasurements& measured, Tension tension);
  void weigh(const Cycle& cycle);
  void learn(const Cycle& cycle);

  Vector deviations_{};                       // deviations of the parameters from the nominal motor
  std::array<Vector, kParameters> doubts_{};  // covariance of the deviations
  float evidence_ = 0;                        // evidence for swapped leads, a logarithm of
                                              // probabilities
  Tension tension_{};                         // voltage of the previous cycle
  Velocity velocity_{};                       // velocity of the previous cycle
  std::optional<HallCount> position_;         // position of the previous cycle
};

}  // namespace wr
