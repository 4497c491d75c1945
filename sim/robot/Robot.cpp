#include "sim/robot/Robot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wr::sim {

namespace {

constexpr int kParts = 10;  // of a step
constexpr std::chrono::nanoseconds kPart = std::chrono::nanoseconds(Robot::kStep) / kParts;
constexpr double kPartSeconds = 1e-4;

constexpr double kCurrentNoise = 0.05;  // A
constexpr double kAngleNoise = 0.05;    // degrees
constexpr double kMisplacement = 0.03;  // of the way between two edges, at most
constexpr double kJitter = 5'000;       // ns

// What the numbers of the noise are for.
constexpr std::uint32_t kForCurrent = 0;
constexpr std::uint32_t kForHall = 8;
constexpr std::uint32_t kForPlaces = 16;
constexpr std::uint32_t kForAngle = 24;

double asVolts(double volts) {
  return std::clamp(volts, 0.0, Robot::kReference);
}

}  // namespace

Robot::Robot(std::uint32_t seed, Surroundings surroundings)
    : noise_(seed), surroundings_(surroundings) {
  placeSensors();
  sample();
}

void Robot::setSeed(std::uint32_t seed) {
  noise_ = Noise(seed);
  placeSensors();
}

void Robot::setNoise(bool on) {
  noisy_ = on;
  placeSensors();
}

void Robot::placeSensors() {
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    std::array<double, 2> misplaced{};
    for (std::size_t sensor = 0; noisy_ && sensor < misplaced.size(); ++sensor) {
      misplaced.at(sensor) = kMisplacement * noise_.uniform(kForPlaces, 2 * wheel + sensor);
    }
    halls_.at(wheel).place(misplaced);
  }
}

void Robot::setFault(Fault fault, std::size_t wheel, bool present) {
  switch (fault) {
    case Fault::Hall:
      hallDead_.at(wheel) = {present, present};
      break;
    case Fault::HallB:
      hallDead_.at(wheel) = {false, present};
      break;
    case Fault::Current:
      currentBroken_.at(wheel) = present;
      break;
    case Fault::Angle:
      angleBroken_ = present;
      break;
    case Fault::Stall:
      steering_.stall(present);
      break;
    case Fault::Block:
      trains_.at(wheel).block(present);
      break;
  }
}

std::span<const HallEdge> Robot::step() {
  sample();
  edges_.clear();
  for (int part = 0; part < kParts; ++part) {
    std::array<double, kWheels> before{};
    std::ranges::transform(trains_, before.begin(), &DriveTrain::turns);
    advance(kPartSeconds);
    for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
      findEdges(wheel, before.at(wheel), part);
    }
  }
  std::ranges::stable_sort(edges_, {}, &HallEdge::offset);
  ++steps_;
  return edges_;
}

void Robot::sample() {
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    const auto source = static_cast<std::uint32_t>(kForCurrent + wheel);
    const double noise = noisy_ ? kCurrentNoise * noise_.normal(source, steps_) : 0.0;
    currentVolts_.at(wheel) =
        currentBroken_.at(wheel)
            ? 0.0
            : asVolts(kMiddle + kPerAmpere * (trains_.at(wheel).current() + noise));
  }
  angleNoise_ = noisy_ ? kAngleNoise * noise_.normal(kForAngle, steps_) : 0.0;
}

// The ground pulls with the weight's share along the slope; the tyres push; rolling resistance acts
// against the movement, and holds a robot that stands until more pulls at it.
void Robot::advance(double seconds) {
  const double rise = surroundings_.slope / 100.0;
  const double across = kMass * kGravity / std::sqrt(1.0 + rise * rise);
  const double grip = surroundings_.grip * across / kWheels;
  double force = -across * rise;
  for (DriveTrain& train : trains_) {
    train.advance(seconds, speed_, grip);
    force += train.force();
  }
  if (speed_ == 0) {
    const double excess = std::abs(force) - surroundings_.staticResistance * across;
    speed_ = std::copysign(std::max(excess, 0.0), force) / kMass * seconds;
  } else {
    const double direction = std::copysign(1.0, speed_);
    force -= direction * surroundings_.rollingResistance * across;
    const double next = speed_ + force / kMass * seconds;
    speed_ = next * direction > 0 ? next : 0.0;
  }
  distance_ += speed_ * seconds;
}

void Robot::findEdges(std::size_t wheel, double from, int part) {
  for (std::size_t sensor = 0; sensor < 2; ++sensor) {
    if (hallDead_.at(wheel).at(sensor)) {
      continue;
    }
    const auto when = halls_.at(wheel).turn(sensor, from, trains_.at(wheel).turns());
    if (!when) {
      continue;
    }
    const auto source = static_cast<std::uint32_t>(kForHall + 2 * wheel + sensor);
    const double jitter = noisy_ ? kJitter * noise_.normal(source, steps_) : 0.0;
    const double offset = (part + *when) * static_cast<double>(kPart.count()) + jitter;
    const auto last = std::ranges::find(edges_.rbegin(), edges_.rend(), wheel, &HallEdge::wheel);
    const std::int64_t first = last != edges_.rend() ? last->offset.count() : 1;
    const auto exact = static_cast<std::int64_t>(offset);
    const std::chrono::nanoseconds end = kStep;
    edges_.push_back({.offset = std::chrono::nanoseconds(std::clamp(exact, first, end.count())),
                      .wheel = wheel,
                      .sensor = sensor,
                      .level = halls_.at(wheel).level(sensor)});
  }
}

double Robot::steeringVolts() const {
  if (angleBroken_) {
    return 0.0;
  }
  return asVolts(kMiddle + (steering_.degrees() + angleNoise_) * kReference / kAngleRange);
}

double Robot::velocityRpm(std::size_t wheel) const {
  return trains_.at(wheel).speed() * 60.0 / (2.0 * std::numbers::pi);
}

}  // namespace wr::sim
