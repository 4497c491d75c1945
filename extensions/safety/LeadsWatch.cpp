#include "safety/LeadsWatch.hpp"

#include <algorithm>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

// The model of the motor has three parameters. The first two are the resistance and the motor
// constant, both relative to the nominal value and divided by the relative supply voltage. The
// third is the voltage that the offset of the current sensor causes. The array contains the
// variances of these parameters before the first cycle.
constexpr std::array<float, 3> kInitialVariances{0.13F * 0.13F, 0.13F * 0.13F, 0.25F * 0.25F};
constexpr float kMaxDeviation = 0.5F;  // greatest deviation of a parameter from its nominal value
// Increase of each variance in a cycle. The increase lets the model follow changes of the
// temperature and of the battery voltage.
constexpr float kVarianceDrift = 1e-6F;

// Standard deviations of the unexplained voltage. The unexplained voltage is the difference between
// the voltage of the wheel and the voltage that the model computes.
constexpr float kNoise = 0.1F;          // [V] noise that is always present
constexpr float kVelocityNoise = 0.3F;  // noise for each volt by which the induced voltage changes
constexpr float kTensionNoise = 0.2F;   // noise for each volt by which the wheel's voltage changes
constexpr float kCurrentNoise = 0.02F;  // noise for each volt across the winding

// The evidence is the logarithm of a ratio of two probabilities: the probability of the
// measurements if the leads are swapped, divided by the probability of the same measurements if the
// leads are correct.
constexpr float kSwappedThreshold = 12.0F;
// Greatest increase of the evidence in a cycle. Because of this limit, a detection needs at least
// two cycles.
constexpr float kMaxRisePerCycle = 6.0F;
constexpr float kMaxFallPerCycle = 3.0F;  // greatest decrease of the evidence in a cycle
constexpr float kDoubtThreshold = 3.0F;   // with this evidence or more, the model does not learn

// The bring-up procedure turns the wheels with at most this voltage, because the leads of a motor
// may still be swapped. Up to this voltage the evidence does not change.
constexpr Tension kBringUp(1000);

constexpr float kMilli = 1e-3F;
constexpr std::size_t kInduced = 1;  // index of the induced voltage in the array inputs

float volts(Tension tension) {
  return static_cast<float>(tension.count()) * kMilli;
}

// Returns the voltage that a velocity induces in the nominal motor.
float induced(Velocity velocity) {
  constexpr float kConstant =
      static_cast<float>(SystemConstants::instance().motorConstant().count()) * kMilli * kMilli;
  return static_cast<float>(velocity.count()) * kConstant;
}

// Returns the voltage that a current causes across the nominal winding.
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
  // Without a Hall edge in this cycle, a measured velocity other than 0 is only an upper bound. The
  // model does not learn from such a velocity.
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
      measured.position && position_ ? edgesBetween(*position_, *measured.position) : HallCount();
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

// Changes the evidence. Swapped leads change the sign of the induced voltage. Therefore swapped
// leads change the unexplained voltage by twice the induced voltage.
void LeadsWatch::weigh(const Cycle& cycle) {
  const float turning = (1 + deviations_[kInduced]) * cycle.inputs[kInduced];
  const float shown = -2 * turning * (cycle.unexplained + turning) * cycle.weight;
  evidence_ = std::clamp(evidence_ + std::clamp(shown, -kMaxFallPerCycle, kMaxRisePerCycle), 0.0F,
                         kSwappedThreshold);
}

// Corrects the model by one step of the algorithm "recursive least squares".
void LeadsWatch::learn(const Cycle& cycle) {
  for (std::size_t row = 0; row < kParameters; ++row) {
    const float gain = cycle.spread[row] * cycle.weight;
    deviations_[row] =
        std::clamp(deviations_[row] + gain * cycle.unexplained, -kMaxDeviation, kMaxDeviation);
    for (std::size_t column = 0; column < kParameters; ++column) {
      doubts_[row][column] -= gain * cycle.spread[column];
    }
    doubts_[row][row] = std::min(doubts_[row][row] + kVarianceDrift, kInitialVariances[row]);
  }
}

}  // namespace wr
