#include "safety/LeadsWatch.hpp"

#include <algorithm>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

// The parameters are the resistance and the motor constant relative to their nominal values,
// divided by the relative supply, and the voltage of the current sensor's offset. The arrays
// contain their variances before the first cycle, and the limits of the learned values.
constexpr std::array<float, 3> kInitialVariances{0.13F * 0.13F, 0.13F * 0.13F, 0.25F * 0.25F};
constexpr float kMaxVariance = 0.5F;
constexpr float kVarianceDrift =
    1e-6F;  // growth of a variance in each cycle, because temperature and battery change

// Standard deviations of the voltage that the model does not explain.
constexpr float kNoise = 0.1F;  // [V] noise that is always present
constexpr float kVelocityNoise =
    0.3F;  // share of the change of the induced voltage since the previous cycle
constexpr float kTensionNoise = 0.2F;   // share of the change of the voltage in a cycle
constexpr float kCurrentNoise = 0.02F;  // share of the voltage across the winding

// The evidence is the logarithm of a ratio: the probability of these measurements with swapped
// leads, divided by their probability with correct leads.
constexpr float kSwappedThreshold = 12.0F;
constexpr float kMaxRisePerCycle = 6.0F;  // a detection needs two cycles
constexpr float kMaxFallPerCycle = 3.0F;  // in a cycle without signs of a swap
constexpr float kDoubtThreshold = 3.0F;   // with more evidence the model does not learn

// Up to this voltage the bring-up turns a wheel whose leads may be swapped.
constexpr Tension kBringUp(1000);

constexpr float kMilli = 1e-3F;
constexpr std::size_t kInduced = 1;  // input: induced voltage

float volts(Tension tension) {
  return static_cast<float>(tension.count()) * kMilli;
}

// Returns the voltage that a velocity induces in the nominal motor.
float induced(Velocity velocity) {
  constexpr float kConstant =
      static_cast<float>(SystemConstants::instance().motorConstant().count()) * kMilli * kMilli;
  return static_cast<float>(velocity.count()) * kConstant;
}

// Returns the voltage of a current across the nominal winding.
float across(Current current) {
  constexpr float kWinding = static_cast<float>(SystemConstants::instance().winding()) * kMilli;
  return static_cast<float>(current.count()) * kMilli * kWinding;
}

float square(float value) {
  return value * value;
}

template <class T>
float product(const T& left, const T& right) {
  float sum = left[0] * right[0];
  for (std::size_t index = 1; index < left.size(); ++index) {
    sum += left[index] * right[index];
  }
  return sum;
}

}  // namespace

LeadsWatch::LeadsWatch() {
  reset();
}

bool LeadsWatch::swapped(const WheelMeasurements& measured, std::optional<Tension> tension) {
  if (!tension || !measured.velocity || !measured.current) {
    return false;
  }
  const Cycle cycle = examine(measured, *tension);
  if (cycle.moved && (*tension > kBringUp || *tension < -kBringUp)) {
    weigh(cycle);
  }
  // Without edges the measured velocity is only an upper bound.
  if (evidence_ < kDoubtThreshold && (cycle.moved || measured.velocity == Velocity())) {
    learn(cycle);
  }
  return evidence_ >= kSwappedThreshold;
}

void LeadsWatch::reset() {
  deviations_ = {};
  doubts_ = {};
  for (std::size_t row = 0; row < kParameters; ++row) {
    doubts_[row][row] = kInitialVariances[row];
  }
  evidence_ = 0;
  tension_ = Tension();
  velocity_ = Velocity();
  position_.reset();
}

LeadsWatch::Cycle LeadsWatch::examine(const WheelMeasurements& measured, Tension tension) {
  const Velocity velocity = *measured.velocity;
  const HallCount way =
      measured.position && position_ ? *measured.position - *position_ : HallCount();
  Cycle cycle;
  cycle.inputs = {across(*measured.current), induced(velocity), 1.0F};
  cycle.unexplained = volts(tension) - cycle.inputs[0] - cycle.inputs[kInduced] -
                      product(cycle.inputs, deviations_);
  for (std::size_t row = 0; row < kParameters; ++row) {
    cycle.spread[row] = product(doubts_[row], cycle.inputs);
  }
  cycle.weight = 1 / (square(kNoise) + square(kVelocityNoise * induced(velocity - velocity_)) +
                      square(kTensionNoise * volts(tension - tension_)) +
                      square(kCurrentNoise * cycle.inputs[0]) +
                      std::max(product(cycle.inputs, cycle.spread), 0.0F));
  cycle.moved =
      velocity > Velocity() ? way > HallCount() : velocity < Velocity() && way < HallCount();
  tension_ = tension;
  velocity_ = velocity;
  position_ = measured.position;
  return cycle;
}

// Swapped leads change the sign of the induced voltage: the balance then differs by twice this
// voltage.
void LeadsWatch::weigh(const Cycle& cycle) {
  const float turning = (1 + deviations_[kInduced]) * cycle.inputs[kInduced];
  const float shown = -2 * turning * (cycle.unexplained + turning) * cycle.weight;
  evidence_ = std::clamp(evidence_ + std::clamp(shown, -kMaxFallPerCycle, kMaxRisePerCycle), 0.0F,
                         kSwappedThreshold);
}

// Executes one step of the recursive least squares.
void LeadsWatch::learn(const Cycle& cycle) {
  for (std::size_t row = 0; row < kParameters; ++row) {
    const float gain = cycle.spread[row] * cycle.weight;
    deviations_[row] =
        std::clamp(deviations_[row] + gain * cycle.unexplained, -kMaxVariance, kMaxVariance);
    for (std::size_t column = 0; column < kParameters; ++column) {
      doubts_[row][column] -= gain * cycle.spread[column];
    }
    doubts_[row][row] = std::min(doubts_[row][row] + kVarianceDrift, kInitialVariances[row]);
  }
}

}  // namespace wr
