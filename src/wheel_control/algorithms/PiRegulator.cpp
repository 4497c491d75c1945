#include "wheel_control/algorithms/PiRegulator.hpp"

#include <algorithm>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr std::int64_t kMicrovolts = 1000;  // in a millivolt
constexpr std::int64_t kMostIntegral = SystemConstants::instance().supply().count() * kMicrovolts;

// A wheel that got less tension than it should have stays behind, and one that got more runs ahead.
bool explains(Tension shortfall, std::int32_t error) {
  return (shortfall > Tension() && error > 0) || (shortfall < Tension() && error < 0);
}

}  // namespace

PiRegulator::PiRegulator(const PiGains& gains) : gains_(gains) {}

Tension PiRegulator::regulate(std::int32_t error) {
  if (!explains(shortfall_, error)) {
    const std::int64_t sum = integral_ + std::int64_t{gains_.integral} * error;
    integral_ = std::clamp(sum, -kMostIntegral, kMostIntegral);
  }
  const std::int64_t tension = std::int64_t{gains_.proportional} * error + integral_;
  return Tension(static_cast<std::int32_t>(tension / kMicrovolts));
}

void PiRegulator::missed(Tension shortfall) {
  shortfall_ = shortfall;
}

void PiRegulator::reset() {
  integral_ = 0;
  shortfall_ = Tension();
}

}  // namespace wr
