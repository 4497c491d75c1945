#include "safety/SteeringGeometry.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <optional>

#include "main_control/MainController.hpp"

namespace wr {

namespace {

constexpr double kWheelbase = 1.582;  // [m]
constexpr double kTrack = 1.054;      // [m]

constexpr std::size_t kDegrees = 33;        // number of factors in the table: 0 to 32 degrees
constexpr std::int32_t kDegree = 100;       // [0.01 degree] one degree
constexpr std::int32_t kFullShare = 10000;  // factor of the wheel with the greatest circle
constexpr double kRadians = std::numbers::pi / 180;

// Velocity factors of three wheels at a steering angle. The outer front wheel has no member: it
// rolls on the greatest circle, and its factor is always kFullShare.
struct Shares {
  std::int32_t innerFront = kFullShare;
  std::int32_t innerRear = kFullShare;
  std::int32_t outerRear = kFullShare;
};

consteval double root(double square) {
  double value = square;
  for (int step = 0; step < 40; ++step) {
    value = (value + square / value) / 2;
  }
  return value;
}

// Returns the tangent of an angle [rad], computed by a continued fraction. Up to 45 degrees the
// first 10 digits are exact.
consteval double tangent(double angle) {
  double fraction = 0;
  for (int odd = 21; odd > 0; odd -= 2) {
    fraction = angle * angle / (odd - fraction);
  }
  return fraction / angle;
}

// Converts a share between 0 and 1 to a rounded integer in the unit 1/kFullShare.
consteval std::int32_t shareOf(double part) {
  return (static_cast<std::int32_t>(2 * kFullShare * part) + 1) / 2;
}

consteval Shares sharesAt(std::size_t degrees) {
  if (degrees == 0) {
    return {};
  }
  const double middle = kWheelbase / tangent(static_cast<double>(degrees) * kRadians);
  const double inner = middle - kTrack / 2;
  const double outer = middle + kTrack / 2;
  const double greatest = root(outer * outer + kWheelbase * kWheelbase);
  const double innerFront = root(inner * inner + kWheelbase * kWheelbase);
  return {.innerFront = shareOf(innerFront / greatest),
          .innerRear = shareOf(inner / greatest),
          .outerRear = shareOf(outer / greatest)};
}

consteval std::array<Shares, kDegrees> table() {
  std::array<Shares, kDegrees> shares{};
  for (std::size_t degrees = 0; degrees < kDegrees; ++degrees) {
    shares[degrees] = sharesAt(degrees);
  }
  return shares;
}

constexpr std::array<Shares, kDegrees> kShares = table();

std::int32_t between(std::int32_t low, std::int32_t high, std::int32_t rest) {
  return low + (high - low) * rest / kDegree;
}

Shares sharesOf(Angle steering) {
  constexpr std::int32_t kMaxAngle = (static_cast<std::int32_t>(kDegrees) - 1) * kDegree;
  const std::int32_t angle = std::min(std::abs(steering.count()), kMaxAngle);
  const auto degrees = static_cast<std::size_t>(angle / kDegree);
  const std::int32_t rest = angle % kDegree;
  const Shares& low = kShares[degrees];
  const Shares& high = kShares[std::min(degrees + 1, kDegrees - 1)];
  return {.innerFront = between(low.innerFront, high.innerFront, rest),
          .innerRear = between(low.innerRear, high.innerRear, rest),
          .outerRear = between(low.outerRear, high.outerRear, rest)};
}

std::int16_t part(std::int16_t velocity, std::int32_t share) {
  return static_cast<std::int16_t>(velocity * share / kFullShare);
}

}  // namespace

SteeringGeometry::SteeringGeometry(Mode& wrapped) : ModeDecorator(ModeId::None, wrapped) {}

void SteeringGeometry::read(MainController& mCtrl) {
  ModeDecorator::read(mCtrl);
  const std::optional<SetPoints>& order = mCtrl.getData().setPoints();
  if (order) {
    mCtrl.getData().saveSetPoints(distributed(*order));
  }
}

void SteeringGeometry::changeMode(MainController& /*mCtrl*/) {}

SetPoints SteeringGeometry::distributed(const SetPoints& order) {
  const WheelSetPoint& first = order.wheels.front();
  const bool alike =
      std::ranges::all_of(order.wheels, [&](const WheelSetPoint& wheel) { return wheel == first; });
  if (!alike || first.quantity != WheelQuantity::Velocity) {
    return order;
  }
  const Shares shares = sharesOf(order.steering);
  const bool left = order.steering > Angle();
  const std::size_t innerFront = left ? 0 : 1;
  const std::size_t innerRear = left ? 2 : 3;
  const std::size_t outerRear = left ? 3 : 2;
  SetPoints result = order;
  result.wheels[innerFront].value = part(first.value, shares.innerFront);
  result.wheels[innerRear].value = part(first.value, shares.innerRear);
  result.wheels[outerRear].value = part(first.value, shares.outerRear);
  return result;
}

}  // namespace wr
