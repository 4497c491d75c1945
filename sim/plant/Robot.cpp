#include "sim/plant/Robot.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wr::plant {

namespace {

constexpr int kParts = 5;  // number of parts of a step
constexpr double kPartSeconds = 2e-4;
constexpr double kStepSeconds = 1e-3;

constexpr double kCurrentNoise = 0.05;  // [A]
constexpr double kAngleNoise = 0.05;    // [degree]
constexpr double kMisplacement =
    0.03;  // greatest displacement of a sensor [fraction of the distance between two edges]
constexpr double kJitter = 5'000;  // [ns]

constexpr double kDegreesPerEdge = 90.0;  // electrical degrees
constexpr std::chrono::nanoseconds kGlitch{30'000};
// The voltage of an open input differs from the voltage of the input that is converted before it.
// In each step, this difference falls by this fraction.
constexpr double kOpenShare = 0.05;
constexpr double kNoPower = 0.05;      // W; noise and rounding cause less power than this limit
constexpr double kSlopeSeconds = 2.0;  // longest time in which the slope changes [s]

// Purposes of the random numbers.
constexpr std::uint32_t kForCurrent = 0;
constexpr std::uint32_t kForHall = 8;
constexpr std::uint32_t kForPlaces = 16;
constexpr std::uint32_t kForAngle = 24;
constexpr std::uint32_t kForGlitches = 32;
constexpr std::uint32_t kForGlitchTimes = 36;
constexpr std::uint32_t kForLosses = 40;

double asVolts(double volts) {
  return std::clamp(volts, 0.0, Robot::kReference);
}

double rpmOf(double radiansPerSecond) {
  return radiansPerSecond * 60.0 / (2.0 * std::numbers::pi);
}

}  // namespace

Robot::Robot(std::uint32_t seed, Ground surroundings)
    : noise_(seed), surroundings_(surroundings), slopeAhead_(surroundings.slope) {
  setPlant({});
  placeSensors();
  sample();
}

void Robot::setSeed(std::uint32_t seed) {
  noise_ = Noise(seed);
  placeSensors();
  if (varied_) {
    setPlant(Plant::varied(noise_));
  }
}

void Robot::setPlant(const Plant& plant) {
  plant_ = plant;
  supply_ = plant.supply;
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    trains_.at(wheel).configure(plant.motors.at(wheel));
  }
}

void Robot::vary(bool varied) {
  varied_ = varied;
  setPlant(varied ? Plant::varied(noise_) : Plant{});
}

void Robot::setParameter(Parameter parameter, double value) {
  Plant plant = plant_;
  plant::setParameter(plant, parameter, value);
  setPlant(plant);
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
    misplaced[1] += hallFaults_.at(wheel).misplaced;
    halls_.at(wheel).place(misplaced);
  }
}

void Robot::setFault(Fault fault, std::size_t wheel, bool present, double value) {
  switch (fault) {
    case Fault::Leads:
      trains_.at(wheel).swapLeads(present);
      break;
    case Fault::Current:
      currentFaults_.at(wheel).broken = present;
      break;
    case Fault::CurrentOpen:
      currentFaults_.at(wheel).open = present;
      break;
    case Fault::CurrentStuck:
      currentFaults_.at(wheel).stuck = present;
      break;
    case Fault::CurrentOffset:
      currentFaults_.at(wheel).offset = present ? value / 1000.0 : 0.0;
      break;
    case Fault::Stall:
      steering_.stall(present);
      break;
    case Fault::Block:
      trains_.at(wheel).block(present);
      break;
    case Fault::LeftEnd:
      leftEndBroken_ = present;
      break;
    case Fault::RightEnd:
      rightEndBroken_ = present;
      break;
    case Fault::Angle:
    case Fault::AngleOpen:
    case Fault::AngleStuck:
    case Fault::AngleDrift:
      setAngleFault(fault, present, value);
      break;
    default:
      setHallFault(fault, hallFaults_.at(wheel), present, value);
      placeSensors();
      break;
  }
}

void Robot::setHallFault(Fault fault, HallFaults& faults, bool present, double value) {
  const double amount = present ? value : 0.0;
  switch (fault) {
    case Fault::Hall:
      faults.dead = {present, present};
      break;
    case Fault::HallA:
      faults.dead = {present, false};
      break;
    case Fault::HallB:
      faults.dead = {false, present};
      break;
    case Fault::HallSwapped:
      faults.swapped = present;
      break;
    case Fault::HallMisplaced:
      faults.misplaced = amount / kDegreesPerEdge;
      break;
    case Fault::HallGlitches:
      faults.glitches = amount;
      break;
    case Fault::HallLosses:
      faults.losses = amount;
      break;
    default:
      break;
  }
}

void Robot::setAngleFault(Fault fault, bool present, double value) {
  keptVolts_ = steeringVolts();
  angleBroken_ = fault == Fault::Angle && present;
  angleOpen_ = fault == Fault::AngleOpen && present;
  angleStuck_ = fault == Fault::AngleStuck && present;
  angleDrift_ = fault == Fault::AngleDrift && present ? value / 100.0 * kStepSeconds : 0.0;
  angleDrifted_ = 0;
}

void Robot::setSlope(double percent) {
  slopeBefore_ = surroundings_.slope;
  slopeAhead_ = percent;
  slopeReached_ = slopeBefore_ == slopeAhead_ ? 1 : 0;
}

void Robot::setEmergencyStop(EmergencyStop state) {
  emergencyStop_ = state;
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    applyDrive(wheel);
  }
  if (!hasPower()) {
    steering_.enable(false);
  }
}

void Robot::setWheel(std::size_t wheel, const WheelDrive& drive) {
  drives_.at(wheel) = drive;
  applyDrive(wheel);
}

void Robot::applyDrive(std::size_t wheel) {
  const bool shorted = emergencyStop_ == EmergencyStop::Brake;
  trains_.at(wheel).set(hasPower() ? drives_.at(wheel)
                                   : WheelDrive{.duty = 0, .backwards = false, .enabled = shorted});
}

std::span<const HallEdge> Robot::step() {
  sample();
  advanceSlope();
  feelGround();
  std::array<double, kWheels> before{};
  std::ranges::transform(trains_, before.begin(), &DriveTrain::turns);
  for (int part = 0; part < kParts; ++part) {
    advance(kPartSeconds);
  }
  edges_.clear();
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    findEdges(wheel, before.at(wheel));
    greatestRpm_ = std::max(greatestRpm_, std::abs(velocityRpm(wheel)));
  }
  std::ranges::stable_sort(edges_, {}, &HallEdge::offset);
  heading_ += yawRate_ * kStepSeconds;
  ++steps_;
  return edges_;
}

void Robot::sample() {
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    const CurrentFaults& faults = currentFaults_.at(wheel);
    if (faults.broken) {
      currentVolts_.at(wheel) = 0;
    } else if (faults.open) {
      currentVolts_.at(wheel) += kOpenShare * (voltsBefore(wheel) - currentVolts_.at(wheel));
    } else if (!faults.stuck) {
      const auto source = static_cast<std::uint32_t>(kForCurrent + wheel);
      const double noise = noisy_ ? kCurrentNoise * noise_.normal(source, steps_) : 0.0;
      const CurrentSensorParameters& sensor = plant_.currentSensors.at(wheel);
      const double amperes = sensor.gain * trains_.at(wheel).driverCurrent() + sensor.offset;
      currentVolts_.at(wheel) = asVolts(kMiddle + kPerAmpere * (amperes + faults.offset + noise));
    }
  }
  sampleAngle();
}

// Returns the voltage of the input that a converter converts before the input of a wheel. The
// voltage of an open input moves towards this voltage, because the converter's capacitor keeps its
// charge. One converter converts the currents of wheels 0 and 1. The other converter converts the
// currents of wheels 2 and 3, and the angle.
double Robot::voltsBefore(std::size_t wheel) const {
  return wheel == 2 ? steeringVolts() : currentVolts_.at(wheel == 0 ? 1 : wheel - 1);
}

void Robot::sampleAngle() {
  angleNoise_ = noisy_ ? kAngleNoise * noise_.normal(kForAngle, steps_) : 0.0;
  angleDrifted_ += angleDrift_;
  if (angleOpen_) {
    keptVolts_ += kOpenShare * (currentVolts_.back() - keptVolts_);
  }
}

double Robot::trueAngleVolts() const {
  const double degrees = plant_.angleGain * steering_.degrees() + plant_.angleOffset;
  return asVolts(kMiddle + (degrees + angleNoise_ + angleDrifted_) * kReference / kAngleRange);
}

double Robot::steeringVolts() const {
  if (angleBroken_) {
    return 0.0;
  }
  return angleOpen_ || angleStuck_ ? keptVolts_ : trueAngleVolts();
}

// While only one axle is on the new slope, the slope of the robot is between the old and the new
// slope. One wheelbase later, the second axle is also on the new slope, and the robot has the new
// slope. The change takes at most kSlopeSeconds, also if the robot drives slowly or is at rest.
void Robot::advanceSlope() {
  if (slopeReached_ >= 1) {
    return;
  }
  const double way = std::abs(speed_) * kStepSeconds / SteeringLinkage::kWheelbase;
  slopeReached_ = std::min(slopeReached_ + std::max(way, kStepSeconds / kSlopeSeconds), 1.0);
  surroundings_.slope = std::lerp(slopeBefore_, slopeAhead_, slopeReached_);
}

// The component of the weight along the slope pulls the robot downhill, for any heading of the
// robot.
void Robot::feelGround() {
  linkage_.turn(steering_.degrees());
  const double rise = surroundings_.slope / 100.0;
  weight_ = plant_.mass * kGravity;
  ground_ = {};
  if (rise != 0) {
    weight_ /= std::sqrt(1.0 + rise * rise);
    ground_ = {.along = -weight_ * rise * std::cos(heading_),
               .across = weight_ * rise * std::sin(heading_),
               .turning = 0};
  }
  grip_ = surroundings_.grip * weight_ / kWheels;
}

Contact Robot::contactOf(const WheelPose& pose) const {
  const double along = speed_ - yawRate_ * pose.y;
  const double across = sideSpeed_ + yawRate_ * pose.x;
  return {.along = along * pose.cosine + across * pose.sine,
          .across = across * pose.cosine - along * pose.sine,
          .grip = grip_};
}

// The tyres push the robot along its axis and sideways, and turn it. The voltage of the battery
// falls under load.
void Robot::advance(double seconds) {
  Forces force = ground_;
  double drawn = 0;
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    DriveTrain& train = trains_[wheel];
    const WheelPose& pose = linkage_.pose(wheel);
    train.advance(seconds, contactOf(pose), supply_);
    const double along = train.force() * pose.cosine - train.sideForce() * pose.sine;
    const double across = train.force() * pose.sine + train.sideForce() * pose.cosine;
    force.along += along;
    force.across += across;
    force.turning += pose.x * across - pose.y * along;
    drawn += train.supplyCurrent();
  }
  supply_ = plant_.supply - plant_.batteryResistance * drawn;
  const double sideSpeed = sideSpeed_;
  sideSpeed_ += (force.across / plant_.mass - yawRate_ * speed_) * seconds;
  advanceAlong(force.along + plant_.mass * yawRate_ * sideSpeed, seconds);
  yawRate_ += force.turning / plant_.yawInertia * seconds;
  distance_ += speed_ * seconds;
}

// Rolling resistance acts against the movement. A robot stays at rest until the force on it is
// greater than its static resistance.
void Robot::advanceAlong(double force, double seconds) {
  if (speed_ == 0) {
    const double excess = std::abs(force) - plant_.staticResistance * weight_;
    speed_ = std::copysign(std::max(excess, 0.0), force) / plant_.mass * seconds;
    return;
  }
  const double direction = std::copysign(1.0, speed_);
  const double rolling = direction * plant_.rollingResistance * weight_;
  const double next = speed_ + (force - rolling) / plant_.mass * seconds;
  speed_ = next * direction > 0 ? next : 0.0;
}

// Computes the edges of a step. In 1 ms, a shaft turns by less than the distance between two edges.
void Robot::findEdges(std::size_t wheel, double from) {
  HallFaults& faults = hallFaults_.at(wheel);
  faults.losesNext = faults.losesNext || happens(kForLosses, wheel, faults.losses);
  for (std::size_t sensor = 0; sensor < 2; ++sensor) {
    if (faults.dead.at(sensor)) {
      continue;
    }
    const auto when = halls_.at(wheel).turn(sensor, from, trains_.at(wheel).turns());
    if (!when) {
      continue;
    }
    if (faults.losesNext) {
      faults.losesNext = false;
      continue;
    }
    const auto source = static_cast<std::uint32_t>(kForHall + 2 * wheel + sensor);
    const double jitter = noisy_ ? kJitter * noise_.normal(source, steps_) : 0.0;
    const double step = static_cast<double>(std::chrono::nanoseconds(kStep).count());
    const auto offset = static_cast<std::int64_t>(*when * step + jitter);
    addEdge({.offset = std::chrono::nanoseconds(offset),
             .wheel = wheel,
             .sensor = faults.swapped ? 1 - sensor : sensor,
             .level = halls_.at(wheel).level(sensor)});
  }
  if (happens(kForGlitches, wheel, faults.glitches)) {
    addGlitch(wheel);
  }
}

// Adds a pulse of the opposite level.
void Robot::addGlitch(std::size_t wheel) {
  const bool level = halls_.at(wheel).level(0);
  const auto source = static_cast<std::uint32_t>(kForGlitchTimes + wheel);
  const double share = 0.45 * (noise_.uniform(source, steps_) + 1.0);
  const std::chrono::nanoseconds begin(static_cast<std::int64_t>(share * 1e6) + 1);
  edges_.push_back({.offset = begin, .wheel = wheel, .sensor = 0, .level = !level});
  edges_.push_back({.offset = begin + kGlitch, .wheel = wheel, .sensor = 0, .level = level});
}

bool Robot::happens(std::uint32_t source, std::size_t wheel, double perSecond) const {
  return perSecond > 0 && noise_.uniform(static_cast<std::uint32_t>(source + wheel), steps_) <
                              2.0 * perSecond * kStepSeconds - 1.0;
}

// Adds an edge. The edges of a wheel stay in the order of time.
void Robot::addEdge(HallEdge edge) {
  const auto last = std::ranges::find(edges_.rbegin(), edges_.rend(), edge.wheel, &HallEdge::wheel);
  const std::chrono::nanoseconds first =
      last != edges_.rend() ? last->offset : std::chrono::nanoseconds(1);
  edge.offset = std::clamp(edge.offset, first, std::chrono::nanoseconds(kStep));
  edges_.push_back(edge);
}

double Robot::velocityRpm(std::size_t wheel) const {
  return rpmOf(trains_.at(wheel).speed());
}

bool Robot::braking() const {
  return std::ranges::all_of(trains_,
                             [](const DriveTrain& train) { return train.power() <= kNoPower; });
}

double Robot::sideSlip(std::size_t wheel) const {
  return contactOf(linkage_.pose(wheel)).across;
}

}  // namespace wr::plant
