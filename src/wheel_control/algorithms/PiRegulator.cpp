#include "wheel_control/algorithms/PiRegulator.hpp"

#include <algorithm>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr std::int32_t kMicrovolts = 1000;  // number of microvolts in a millivolt
constexpr std::int32_t kMaxIntegral = SystemConstants::instance().supply().count() * kMicrovolts;

// A difference between the calculated and the applied voltage explains an error only if this
// difference is at least kMinShortfall. A demand of less than 0.1 V in the direction opposite to
// the orientation of the wheel is not applied. The integral must be able to raise this demand.
// Therefore an error is added to the integral while the difference is smaller than kMinShortfall.
constexpr Tension kMinShortfall(100);

// Returns whether a missing voltage explains an error. A wheel with less voltage than calculated is
// too slow, and a wheel with more voltage than calculated is too fast.
bool explains(Tension shortfall, std::int32_t error) {
  return (shortfall >= kMinShortfall && error > 0) || (shortfall <= -kMinShortfall && error < 0);
}

}  // namespace

PiRegulator::PiRegulator(const PiGains& gains) : gains_(gains) {}

Tension PiRegulator::regulate(std::int32_t error) {
  std::int32_t sum = majority(integral_);
  if (!explains(shortfall_, error)) {
    sum = std::clamp(sum + gains_.integral * error, -kMaxIntegral, kMaxIntegral);
  }
  integral_.fill(sum);
  return Tension((gains_.proportional * error + sum) / kMicrovolts);
}

void PiRegulator::missed(Tension shortfall) {
  shortfall_ = shortfall;
}

void PiRegulator::reset() {
  integral_.fill(0);
  shortfall_ = Tension();
}

std::int32_t PiRegulator::majority(const Copies& copies) {
  const auto& [a, b, c] = copies;
  return (a & b) | (b & c) | (a & c);
}

}  // namespace wr
