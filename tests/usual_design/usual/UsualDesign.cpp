#include "usual_design/usual/UsualDesign.hpp"

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "communication/pc_connection/FirmwareIdentity.hpp"
#include "functions/scaling.hpp"
#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr const SystemConstants& kConstants = SystemConstants::instance();
constexpr std::uint8_t kN = kConstants.waitingCycles();

// Operation states, with their numbers in reports.
constexpr std::uint8_t kWorking = 0;
constexpr std::uint8_t kWaiting = 1;
constexpr std::uint8_t kWaitingN = 2;
constexpr std::uint8_t kReconnecting = 3;

constexpr std::size_t kOrderLength = 21;
constexpr std::size_t kCommandsAt = 20;
constexpr std::uint32_t kStopCommand = 1;
constexpr std::uint32_t kCommands = 3;
constexpr std::size_t kReportLength = 130;
constexpr std::size_t kWelcomeLength = 29;
constexpr std::size_t kMostBytes = 4096;
constexpr std::uint32_t kMostAhead = 127;

// Widths and periods of the pulses of the remote control.
constexpr Microseconds kShortestPeriod = milliseconds(15);
constexpr Microseconds kLongestPeriod = milliseconds(30);
constexpr std::int32_t kMiddle = 1500;
constexpr std::int32_t kMiddleBand = 20;
constexpr std::int32_t kFullDeflection = 500;
constexpr std::int32_t kShortest = 900;
constexpr std::int32_t kLongest = 2100;

// Hall sensors.
constexpr std::array<std::array<std::int8_t, 4>, 4> kDirections = {{
    {0, 1, -1, 0},
    {-1, 0, 0, 1},
    {1, 0, 0, -1},
    {0, -1, 1, 0},
}};
constexpr std::int32_t kTurnPerMicrosecond = 600'000'000;  // [0.1 rpm]
constexpr std::int32_t kGreatestVelocity = 6000;           // [0.1 rpm]
constexpr Microseconds kLeastReversal = milliseconds(25);
constexpr Velocity kMoving(300);
constexpr std::uint32_t kMostImplausible = 3;
constexpr Microseconds kStandstill = milliseconds(500);

// Current sensor. Its range is 33000 mA over 4096 steps.
constexpr std::int32_t kZeroSamples = 64;
constexpr std::int32_t kMilliamperes = 33000;
constexpr std::int32_t kRange = 4096;
constexpr std::int32_t kZeroTolerance = (kRange - 1) / 20;
constexpr std::int32_t kOvercurrent = 15000 * kRange / kMilliamperes;
constexpr std::int32_t kGreatestCurrent = 16000;
constexpr std::uint32_t kTooManyInARow = 5;
constexpr std::uint32_t kGroup = 8;

// Control of the wheel. docs/wheel_control.rst derives the gains.
constexpr std::int64_t kThousand = 1000;
constexpr std::int64_t kDecay = 637;
constexpr std::int64_t kMean = 806;
constexpr PiGains kVelocityGains{.proportional = 4650, .integral = 2094};
constexpr std::int32_t kWinding = kConstants.winding();
constexpr PiGains kCurrentGains{.proportional = 0, .integral = kWinding / 2};
constexpr Tension kSlight(100);
constexpr std::uint8_t kSlowCycles = 2;
constexpr Tension kRise(12000);
constexpr Tension kFall(2400);
constexpr std::uint8_t kBrakedCycles = 10;
constexpr Velocity kCreep(800);
constexpr Tension kLeastEffort(2000);
constexpr std::int32_t kMostEffort = 45000;
constexpr Tension kFaint(3200);
constexpr Tension kWeak(14000);
constexpr std::int32_t kWeakShare = 16;
constexpr std::int32_t kStrongShare = 8;
constexpr std::int32_t kJitter = 1;
constexpr Tension kReversal(500);
constexpr std::uint8_t kMostWaiting = 20;
constexpr std::int32_t kDoubt = 400;
constexpr std::int32_t kDoubtShare = 3;
constexpr std::uint8_t kMostDoubts = 5;
constexpr std::int32_t kWholeDuty = 10000;

void count(std::uint16_t& counter) {
  if (counter < std::numeric_limits<std::uint16_t>::max()) {
    ++counter;
  }
}

bool within(std::int32_t value, std::int32_t limit) {
  return -limit <= value && value <= limit;
}

bool isSlow(Velocity velocity, Velocity slow = kConstants.slow()) {
  return velocity < slow && velocity > -slow;
}

bool isMoving(Velocity velocity) {
  return velocity >= kMoving || velocity <= -kMoving;
}

std::uint32_t get16(std::span<const std::uint8_t> bytes, std::size_t at) {
  return bytes[at] | static_cast<std::uint32_t>(bytes[at + 1]) << 8U;
}

std::int16_t getSigned16(std::span<const std::uint8_t> bytes, std::size_t at) {
  return static_cast<std::int16_t>(get16(bytes, at));
}

// Writes numbers into a payload, one after the other.
class Payload {
 public:
  explicit Payload(std::uint8_t* place) : place_(place) {}

  void put8(std::uint32_t value) { *place_++ = static_cast<std::uint8_t>(value); }
  void put16(std::uint32_t value) {
    put8(value);
    put8(value >> 8U);
  }
  void put32(std::uint32_t value) {
    put16(value);
    put16(value >> 16U);
  }
  void putNearest16(std::int32_t value) {
    using Limits = std::numeric_limits<std::int16_t>;
    put16(
        static_cast<std::uint32_t>(std::clamp<std::int32_t>(value, Limits::min(), Limits::max())));
  }

 private:
  std::uint8_t* place_;
};

}  // namespace

UsualDesign::UsualDesign(const Devices& devices)
    : devices_(devices), velocityRegulator_(kVelocityGains), currentRegulator_(kCurrentGains) {}

void UsualDesign::start() {
  devices_.rcVelocity.start();
  devices_.rcDirection.start();
  takeHallPhase();
  devices_.hallA.start();
  devices_.hallB.start();
  devices_.tickTimer.start(kConstants.tickPeriod());
  devices_.cycleTimer.start(kConstants.cyclePeriod());
}

// ---- control cycle -----------------------------------------------------------------------------

void UsualDesign::cycleTimerExpired() {
  devices_.cycleTimer.acknowledge();
  const std::uint32_t number = pulses_.load() + 1;
  pulse_.write({.number = number, .awake = devices_.timebase.awakeCycles()},
               devices_.timebase.now());
  pulses_.store(number);
}

void UsualDesign::cycle() {
  const std::optional<Stamped<Pulse>> pulse = pulse_.read();
  const std::uint32_t awake = pulse->value.awake;
  costs_ = {.report = reportCost_,
            .awake = awake - awakeAtPulse_.value_or(awake),
            .start = devices_.timebase.awakeCycles() - awake};
  awakeAtPulse_ = awake;
  begun_ = pulse->value.number;
  clockPulse_ = pulse->at;
  ++cycle_;
  orderRead_ = false;
  overran_ = false;
  servePc();
  readOrder();
  control();
  sendReport();
  reportCost_ = devices_.timebase.awakeCycles() - awake;
  devices_.watchdog.refresh();
}

void UsualDesign::readOrder() {
  const Instant now = devices_.timebase.now();
  if (mode_ == Mode::Pc) {
    if (pcOrderIsNew()) {
      countNoMsg_ = 0;
      setPoints_ = pcOrder_;
      pcOrderUnread_ = false;
      source_ = Mode::Pc;
      orderRead_ = true;
    } else {
      if (countNoMsg_ <= kN) {
        ++countNoMsg_;
      }
      if (countNoMsg_ >= kN) {
        mode_ = Mode::Rc;
      }
    }
  } else {
    const std::optional<Stamped<std::int32_t>> velocity = rcVelocity_.value.read();
    const std::optional<Stamped<std::int32_t>> direction = rcDirection_.value.read();
    if (isNew(velocity, rcVelocity_.read, now) && isNew(direction, rcDirection_.read, now)) {
      countNoMsg_ = 0;
      readRcOrder(*velocity, *direction);
      source_ = Mode::Rc;
      orderRead_ = true;
    } else {
      if (countNoMsg_ <= kN) {
        ++countNoMsg_;
      }
      if (countNoMsg_ >= kN) {
        mode_ = Mode::Pc;
      }
    }
  }
}

bool UsualDesign::pcOrderIsNew() const {
  return link_ == Link::Connected && pcOrderUnread_ &&
         clockPulse_ - pcOrderAt_ <= kConstants.orderLifetime();
}

bool UsualDesign::isNew(const std::optional<Stamped<std::int32_t>>& value,
                        const std::optional<Instant>& read, Instant now) {
  return value && now - value->at <= kConstants.orderLifetime() && (!read || value->at > *read);
}

void UsualDesign::readRcOrder(const Stamped<std::int32_t>& velocity,
                              const Stamped<std::int32_t>& direction) {
  rcVelocity_.read = velocity.at;
  rcDirection_.read = direction.at;
  SetPoints order;
  order.steering = Angle(direction.value);
  for (WheelSetPoint& wheel : order.wheels) {
    wheel = {.quantity = WheelQuantity::Velocity,
             .value = static_cast<std::int16_t>(velocity.value)};
  }
  setPoints_ = order;
}

void UsualDesign::control() {
  const Instant now = devices_.timebase.now();
  const HallRecord hall = hallRecord_.read().value_or(Stamped<HallRecord>()).value;
  measureVelocity(hall, now);
  measureCurrent();
  WheelMeasurements& wheel = measurements_.wheels[0];
  wheel.position = HallCount(hall.count);
  wheel.rejectedEdges = hall.unclear + hall.reversals;
  wheel.velocity.reset();
  if (velocityAt_ && now - *velocityAt_ <= kConstants.measurementLifetime()) {
    wheel.velocity = velocity_;
  }
  wheel.current.reset();
  if (currentAt_ && now - *currentAt_ <= kConstants.measurementLifetime()) {
    wheel.current = meanCurrent_;
  }
  held_ = stop_ || countNoMsg_ > kN || !setPoints_;
  if (!held_ && setPoints_->acknowledge) {
    held_ = true;
    if (setPoints_->neutral() && orderRead_) {
      release(wheel);
    }
  }
  if (trip_.load() != Trip::None) {
    driverOff();
  } else if (held_) {
    waitingCycles_ = 0;
    lower();
  } else {
    followSetPoint(setPoints_->wheels[0], HallCount(hall.count), wheel);
  }
  wheel.cutOff = trip_.load() != Trip::None;
  wheel.blind = blind_;
  wheel.reversalLate = reversalLate_;
}

void UsualDesign::release(const WheelMeasurements& wheel) {
  blind_ = false;
  effort_ = 0;
  reversalLate_ = false;
  waitingCycles_ = 0;
  if (wheel.velocity && isSlow(*wheel.velocity)) {
    releaseTrip();
  }
}

// If no cycle has reported a trip yet, this trip stays latched.
void UsualDesign::releaseTrip() {
  if (trip_.load() != Trip::None && trip_.load() != Trip::Tripped) {
    trip_.store(Trip::None);
  }
}

void UsualDesign::sendReport() {
  if (pulses_.load() != begun_) {
    overran_ = true;
    count(overruns_);
  }
  if (link_ != Link::Connected) {
    return;
  }
  std::uint8_t state = kReconnecting;
  if (countNoMsg_ == 0) {
    state = kWorking;
  } else if (countNoMsg_ < kN) {
    state = kWaiting;
  } else if (countNoMsg_ == kN) {
    state = kWaitingN;
  }
  std::array<std::uint8_t, kReportLength> bytes{};
  Payload payload(bytes.data());
  payload.put32(cycle_);
  payload.put32(static_cast<std::uint32_t>(clockPulse_.sinceStart() / 1000U));
  payload.put8(state);
  payload.put8(static_cast<std::uint8_t>(mode_));
  payload.put8(static_cast<std::uint8_t>(source_));
  payload.put8((stop_ ? 1U : 0U) | (orderRead_ ? 2U : 0U) | (held_ ? 4U : 0U) |
               (overran_ ? 8U : 0U));
  const SetPoints setPoints = setPoints_.value_or(SetPoints{});
  payload.put16(setPoints.orderId);
  payload.putNearest16(setPoints.steering.count());
  for (const WheelSetPoint& wheel : setPoints.wheels) {
    payload.put8(static_cast<std::uint8_t>(wheel.quantity));
    payload.put16(static_cast<std::uint16_t>(wheel.value));
  }
  payload.putNearest16(measurements_.steering.value_or(Angle()).count());
  std::uint32_t measured = 0;
  std::uint32_t cutOffs = 0;
  std::uint32_t blindWheels = 0;
  for (std::size_t i = 0; i < kWheelCount; ++i) {
    const WheelMeasurements& wheel = measurements_.wheels[i];
    payload.putNearest16(wheel.velocity.value_or(Velocity()).count());
    payload.putNearest16(wheel.current.value_or(Current()).count());
    payload.put32(static_cast<std::uint32_t>(wheel.position.value_or(HallCount()).count()));
    measured |= (wheel.velocity ? 1U : 0U) << (3 * i);
    measured |= (wheel.current ? 2U : 0U) << (3 * i);
    measured |= (wheel.position ? 4U : 0U) << (3 * i);
    cutOffs |= (wheel.cutOff ? 1U : 0U) << i;
    blindWheels |= (wheel.blind ? 1U : 0U) << i;
  }
  payload.put16(measured);
  payload.putNearest16(applied_.value_or(Tension()).count());
  payload.put32(0);  // voltages of the wheels 1 to 3
  payload.put16(0);
  payload.put8(0);  // turn of the steering
  payload.put8(applied_ ? 1 : 0);
  payload.put16(overruns_);
  payload.put16(counts_.lostBytes);
  payload.put16(counts_.damaged);
  payload.put16(counts_.tooLong);
  payload.put16(counts_.unknownVersion);
  payload.put16(counts_.unknownType);
  payload.put16(counts_.wrongLength);
  payload.put16(counts_.outOfRange);
  payload.put16(counts_.unexpected);
  payload.put16(counts_.sequenceGaps);
  payload.put16(counts_.reportsNotSent);
  payload.put8(static_cast<std::uint8_t>(measurements_.steeringState));
  payload.put8((measurements_.leftEnd ? 1U : 0U) | (measurements_.rightEnd ? 2U : 0U));
  payload.put8(cutOffs);
  payload.put8(blindWheels);
  for (const WheelMeasurements& wheel : measurements_.wheels) {
    constexpr std::uint32_t kMostEdges = std::numeric_limits<std::uint16_t>::max();
    payload.put16(static_cast<std::uint16_t>(std::min(wheel.rejectedEdges, kMostEdges)));
  }
  payload.put32(costs_.report);
  payload.put32(costs_.awake);
  payload.put32(costs_.start);
  std::uint32_t inhibit = 0;
  if (stop_) {
    inhibit = static_cast<std::uint32_t>(Inhibit::Stop);
  } else if (held_) {
    inhibit = static_cast<std::uint32_t>(Inhibit::NoOrder);
  }
  payload.put8(inhibit);
  payload.put8(0);  // no protective stop
  payload.put8(Protection::kNoWheel);
  payload.put8(stop_ ? 1U << static_cast<std::uint32_t>(Mode::Pc) : 0U);
  payload.put32(setPoints.sentAt);
  payload.put16(counts_.staleOrders);
  if (!send(FrameType::Report, bytes)) {
    count(counts_.reportsNotSent);
  }
}

// ---- link to the PC ----------------------------------------------------------------------------

void UsualDesign::servePc() {
  stopReceived_ = false;
  std::size_t left = kMostBytes;
  std::size_t received = 1;
  while (left != 0 && received != 0) {
    const std::span<std::uint8_t> storage = decoder_.storage();
    received = devices_.pcPort.read(storage.first(std::min(left, storage.size())));
    left -= received;
    switch (received == 0 ? Decoded::Nothing : decoder_.push(received)) {
      case Decoded::Nothing:
        break;
      case Decoded::Whole:
        receive(decoder_.frame());
        break;
      case Decoded::Damaged:
        count(counts_.damaged);
        break;
      case Decoded::TooLong:
        count(counts_.tooLong);
        break;
      case Decoded::UnknownVersion:
        if (decoder_.frame().type == FrameType::Hello) {
          receive(decoder_.frame());
        } else {
          count(counts_.unknownVersion);
        }
        break;
    }
  }
  stop_ = pcStop_ || stopReceived_;
  counts_.lostBytes = devices_.pcPort.lostBytes();
  checkSilence(clockPulse_);
  if (welcomeDue_) {
    sendWelcome();
  }
}

void UsualDesign::checkSilence(Instant at) {
  if (link_ == Link::Connected) {
    if (at - lastAccepted_ >= kConstants.linkTimeout()) {
      pcOrderUnread_ = false;
      link_ = Link::Disconnected;
    }
  } else if (link_ == Link::Handshaking && !welcomeDue_) {
    if (at - welcomed_ > kConstants.handshakeTimeout()) {
      link_ = Link::Disconnected;
    }
  }
}

void UsualDesign::receive(const Frame& frame) {
  receivedAt_ = devices_.pcPort.receivedAt();
  checkSilence(receivedAt_);
  std::size_t length = 0;
  switch (frame.type) {
    case FrameType::Hello:
    case FrameType::KeepAlive:
      break;
    case FrameType::Confirm:
      length = 1;
      break;
    case FrameType::Order:
      length = kOrderLength;
      break;
    default:
      count(counts_.unknownType);
      return;
  }
  if (frame.payload.size() < length) {
    count(counts_.wrongLength);
    return;
  }
  if (accept(frame)) {
    const bool hello = frame.type == FrameType::Hello;
    if (!hello && frame.sequence != static_cast<std::uint8_t>(newestReceived_ + 1)) {
      count(counts_.sequenceGaps);
    }
    if (hello || isNewer(frame.sequence)) {
      newestReceived_ = frame.sequence;
    }
    lastAccepted_ = receivedAt_;
  }
}

bool UsualDesign::isNewer(std::uint8_t sequence) const {
  const auto ahead = static_cast<std::uint8_t>(sequence - newestReceived_);
  return ahead != 0 && ahead <= kMostAhead;
}

bool UsualDesign::accept(const Frame& frame) {
  if (frame.type == FrameType::Hello) {
    if (link_ == Link::Connected) {
      pcOrderUnread_ = false;
    }
    welcomeDue_ = true;
    offered_ = false;
    link_ = Link::Handshaking;
    return true;
  }
  if (frame.type == FrameType::Confirm) {
    if (link_ == Link::Handshaking && offered_ && frame.payload.front() == session_) {
      link_ = Link::Connected;
      return true;
    }
  } else {
    const bool order = frame.type == FrameType::Order;
    if (order && (frame.payload[kCommandsAt] & kStopCommand) != 0) {
      pcStop_ = true;
      stopReceived_ = true;
    }
    if (link_ == Link::Connected) {
      if (!order) {
        return true;
      }
      if (!isNewer(frame.sequence)) {
        count(counts_.staleOrders);
        return false;
      }
      if (takeOrder(frame.payload)) {
        return true;
      }
      count(counts_.outOfRange);
      return false;
    }
  }
  count(counts_.unexpected);
  return false;
}

bool UsualDesign::takeOrder(std::span<const std::uint8_t> payload) {
  SetPoints order;
  order.orderId = static_cast<std::uint16_t>(get16(payload, 0));
  order.sentAt = static_cast<std::uint32_t>(get16(payload, 2)) |
                 static_cast<std::uint32_t>(get16(payload, 4)) << 16U;
  order.steering = Angle(getSigned16(payload, 6));
  if (!within(order.steering.count(), kConstants.steeringLimit().count())) {
    return false;
  }
  bool neutral = true;
  std::size_t at = 8;
  for (WheelSetPoint& wheel : order.wheels) {
    wheel.quantity = static_cast<WheelQuantity>(payload[at]);
    wheel.value = getSigned16(payload, at + 1);
    at += 3;
    neutral = neutral && wheel.value == 0;
    std::int32_t limit = -1;
    switch (wheel.quantity) {
      case WheelQuantity::Velocity:
        limit = kConstants.velocityLimit().count();
        break;
      case WheelQuantity::Tension:
        limit = kConstants.tensionLimit().count();
        break;
      case WheelQuantity::Current:
        limit = kConstants.currentLimit().count();
        break;
    }
    if (!within(wheel.value, limit)) {
      return false;
    }
  }
  const std::uint32_t commands = payload[kCommandsAt];
  if (commands > kCommands) {
    return false;
  }
  order.acknowledge = (commands & ~kStopCommand) != 0;
  pcStop_ = (commands & kStopCommand) != 0 || (pcStop_ && !neutral);
  pcOrder_ = order;
  pcOrderAt_ = receivedAt_;
  pcOrderUnread_ = true;
  return true;
}

void UsualDesign::sendWelcome() {
  const std::uint8_t session = session_ == std::numeric_limits<std::uint8_t>::max()
                                   ? std::uint8_t{1}
                                   : static_cast<std::uint8_t>(session_ + 1);
  welcomeDue_ = false;
  std::array<std::uint8_t, kWelcomeLength> bytes{};
  Payload payload(bytes.data());
  payload.put8(session);
  payload.put8(firmwareIdentity.major);
  payload.put8(firmwareIdentity.minor);
  payload.put8(firmwareIdentity.patch);
  for (const char letter : firmwareIdentity.buildId) {
    payload.put8(static_cast<std::uint8_t>(letter));
  }
  payload.put16(static_cast<std::uint32_t>(kConstants.cyclePeriod().count() / kThousand));
  payload.put8(kN);
  payload.put8(static_cast<std::uint8_t>(devices_.start.cause));
  payload.put8(static_cast<std::uint8_t>(devices_.start.fault));
  payload.put16(devices_.start.number);
  payload.put32(devices_.start.address);
  payload.put8(kLowestVersion);
  payload.put8(kHighestVersion);
  payload.put32(firmwareIdentity.schemaHash);
  if (send(FrameType::Welcome, bytes)) {
    session_ = session;
    offered_ = true;
    welcomed_ = clockPulse_;
  }
}

bool UsualDesign::send(FrameType type, std::span<const std::uint8_t> payload) {
  const Frame frame{.type = type, .sequence = nextSent_, .payload = payload};
  const std::span<const std::uint8_t> coded = encoder_.encode(frame);
  if (!sentFirst_) {
    if (devices_.pcPort.free() <= coded.size()) {
      return false;
    }
    constexpr std::array<std::uint8_t, 1> kEnd{0};
    devices_.pcPort.write(kEnd);
    sentFirst_ = true;
  }
  if (!devices_.pcPort.write(coded)) {
    return false;
  }
  ++nextSent_;
  return true;
}

// ---- remote control ----------------------------------------------------------------------------

void UsualDesign::remoteControlEdge() {
  if (devices_.rcVelocity.acknowledge()) {
    takeRcEdge(rcVelocity_, devices_.rcVelocity.level(), kConstants.velocityLimit().count());
  }
  if (devices_.rcDirection.acknowledge()) {
    takeRcEdge(rcDirection_, devices_.rcDirection.level(), kConstants.steeringLimit().count());
  }
}

void UsualDesign::takeRcEdge(RcChannel& channel, bool rising, std::int32_t fullDeflection) {
  const Instant now = devices_.timebase.now();
  if (rising) {
    if (channel.rise) {
      channel.period = now - *channel.rise;
    }
    channel.rise = now;
    return;
  }
  if (!channel.rise || !channel.period || *channel.period < kShortestPeriod ||
      *channel.period > kLongestPeriod) {
    return;
  }
  const Microseconds pulse = now - *channel.rise;
  if (pulse >= *channel.period || pulse.count() < kShortest || pulse.count() > kLongest) {
    return;
  }
  const auto distance = static_cast<std::int32_t>(pulse.count()) - kMiddle;
  std::int32_t value = 0;
  if (distance < -kMiddleBand || distance > kMiddleBand) {
    const std::int32_t deflection = std::clamp(distance, -kFullDeflection, kFullDeflection);
    value = *quotient(std::int64_t{deflection} * fullDeflection, kFullDeflection);
  }
  channel.value.write(value, now);
}

// ---- sensors of the wheel ----------------------------------------------------------------------

void UsualDesign::hallEdge() {
  const bool edgeOfA = devices_.hallA.acknowledge();
  const bool edgeOfB = devices_.hallB.acknowledge();
  if (edgeOfA || edgeOfB) {
    takeHallPhase();
  }
}

void UsualDesign::takeHallPhase() {
  const auto phase = static_cast<std::uint8_t>((devices_.hallA.level() ? 1U : 0U) |
                                               (devices_.hallB.level() ? 2U : 0U));
  const Instant now = devices_.timebase.now();
  if (!phase_) {
    phase_ = phase;
    return;
  }
  const std::int8_t direction = kDirections[*phase_][phase];
  phase_ = phase;
  if (direction != 0) {
    if (direction + direction_ == 0 && now - lastEdge_ < kLeastReversal) {
      ++hall_.reversals;
    }
    direction_ = direction;
    lastEdge_ = now;
    hall_.last = now;
    hall_.count += direction;
  } else {
    ++hall_.unclear;
  }
  hallRecord_.write(hall_, now);
}

void UsualDesign::tickTimerExpired() {
  devices_.tickTimer.acknowledge();
  const std::optional<std::uint16_t> sample = devices_.current.sample();
  if (sample) {
    takeCurrentSample(*sample);
  }
}

void UsualDesign::takeCurrentSample(std::int32_t raw) {
  if (!zeroPlausible_) {
    if (zeroSamples_ < kZeroSamples) {
      zero_ += raw;
      ++zeroSamples_;
      if (zeroSamples_ == kZeroSamples) {
        zero_ = (zero_ + kZeroSamples / 2) / kZeroSamples;
        zeroPlausible_ = std::abs(zero_ - kRange / 2) <= kZeroTolerance;
        leastSample_ = std::max<std::int32_t>(zero_ - kOvercurrent, 1);
        greatestSample_ = std::min<std::int32_t>(zero_ + kOvercurrent, kRange - 2);
      }
    }
    return;
  }
  if (raw >= leastSample_ && raw <= greatestSample_) {
    tooHigh_ = 0;
  } else {
    if (tooHigh_ < kTooManyInARow) {
      ++tooHigh_;
    }
    if (tooHigh_ == kTooManyInARow) {
      if (trip_.load() == Trip::None) {
        trip_.store(Trip::Tripped);
      } else if (trip_.load() == Trip::Braking) {
        trip_.store(Trip::Off);
      }
      devices_.enable.set(false);
    }
  }
  current_.sum += static_cast<std::uint32_t>(raw - zero_);
  ++current_.number;
  if (current_.number % kGroup == 0) {
    current_.at = devices_.timebase.now();
    currentRecord_.write(current_, current_.at);
  }
}

void UsualDesign::measureVelocity(const HallRecord& record, Instant now) {
  std::optional<Velocity> measured;
  if (record.last != seenEdge_) {
    const std::int32_t edges = record.count - seenCount_;
    const Instant from = standing_ ? measuredAt_ : *seenEdge_;
    if (standing_) {
      // The wheel was at rest at an unknown position between two edges. On average, the wheel
      // reaches the first edge after half of the distance between two edges.
      const std::int32_t direction = std::clamp<std::int32_t>(edges, -1, 1);
      measured = velocityOf(2 * edges - direction, (now - from) * 2);
    } else {
      measured = velocityOf(edges, *record.last - from);
    }
    seenEdge_ = record.last;
    seenCount_ = record.count;
    standing_ = false;
    if (measured) {
      measured = bounded(*measured, edges, now - from);
    }
  } else {
    standing_ = standing_ || now - *seenEdge_ >= kStandstill;
    measured = standing_ ? Velocity(0) : bounded(velocity_, 0, now - *seenEdge_);
  }
  measuredAt_ = now;
  if (measured && plausible(record)) {
    writtenBefore_ = velocity_;
    velocity_ = *measured;
    velocityAt_ = now;
  }
  seenHall_ = record;
}

bool UsualDesign::plausible(const HallRecord& record) const {
  const bool moving = isMoving(velocity_) || isMoving(writtenBefore_);
  const std::uint32_t reversals = moving ? record.reversals - seenHall_.reversals : 0;
  return record.unclear - seenHall_.unclear + reversals <= kMostImplausible;
}

// Limits a velocity to the greatest value that is possible, because a faster wheel would have
// caused one more edge.
Velocity UsualDesign::bounded(Velocity value, std::int32_t edges, Microseconds elapsed) const {
  const std::optional<Velocity> bound = velocityOf(std::abs(edges) + 1, elapsed);
  return bound ? std::clamp(value, -*bound, *bound) : value;
}

std::optional<Velocity> UsualDesign::velocityOf(std::int32_t edges, Microseconds elapsed) const {
  const std::int64_t time =
      std::clamp<std::int64_t>(elapsed.count(), 0, std::numeric_limits<std::int32_t>::max());
  const std::optional<std::int32_t> value =
      quotient(std::int64_t{edges} * kTurnPerMicrosecond, time * kConstants.hallEdgesPerTurn());
  if (!value || !within(*value, kGreatestVelocity)) {
    return std::nullopt;
  }
  return Velocity(*value);
}

void UsualDesign::measureCurrent() {
  const CurrentRecord record = currentRecord_.read().value_or(Stamped<CurrentRecord>()).value;
  const auto sum = static_cast<std::int32_t>(record.sum - seenCurrent_.sum);
  const auto number = static_cast<std::int32_t>(record.number - seenCurrent_.number);
  seenCurrent_ = record;
  const std::optional<std::int32_t> value =
      quotient(std::int64_t{sum} * kMilliamperes, std::int64_t{kRange} * number);
  if (value && within(*value, kGreatestCurrent)) {
    meanCurrent_ = Current(*value);
    currentAt_ = record.at;
  }
}

// ---- control of the wheel ----------------------------------------------------------------------

void UsualDesign::followSetPoint(const WheelSetPoint& setPoint, HallCount position,
                                 WheelMeasurements& wheel) {
  watchMotion(setPoint, position, wheel.current.value_or(Current()));
  if (!wheel.velocity || !wheel.current || blind_ || reversalLate_) {
    lower();
    return;
  }
  if (setPoint.quantity != quantity_) {
    resetAlgorithms();
    quantity_ = setPoint.quantity;
  }
  const Tension calculated = calculate(setPoint, *wheel.velocity, *wheel.current);
  const Tension most = kConstants.tensionLimit();
  apply(std::clamp(calculated, -most, most), *wheel.velocity);
  switch (quantity_) {
    case WheelQuantity::Velocity:
      velocityRegulator_.missed(calculated - *applied_);
      velocityApplied_ = *applied_;
      if (*applied_ != calculated) {
        model_ = usedVelocity_.count() * kThousand;
      }
      break;
    case WheelQuantity::Current:
      currentRegulator_.missed(calculated - *applied_);
      break;
    case WheelQuantity::Tension:
      break;
  }
  watchReversal(setPoint, calculated);
}

void UsualDesign::watchMotion(const WheelSetPoint& setPoint, HallCount position, Current current) {
  const Tension applied = applied_.value_or(Tension());
  const std::int32_t tension = std::abs(applied.count());
  if (std::abs(edgesBetween(stillPosition_, position).count()) > kJitter) {
    stillPosition_ = position;
    effort_ = 0;
  } else if (tension <= kLeastEffort.count() || setPoint == WheelSetPoint{}) {
    effort_ = std::max(effort_ - kLeastEffort.count(), std::int32_t{0});
  } else {
    const Tension winding(kWinding * current.count() / static_cast<std::int32_t>(kThousand));
    const bool held = applied > Tension() ? winding * 2 > applied : winding * 2 < applied;
    const bool faint = setPoint.quantity == WheelQuantity::Tension && tension <= kFaint.count();
    const std::int32_t share = tension <= kWeak.count() ? kWeakShare : kStrongShare;
    effort_ += held && !faint ? tension / share : tension;
  }
  blind_ = blind_ || effort_ >= kMostEffort;
}

void UsualDesign::watchReversal(const WheelSetPoint& setPoint, Tension demand) {
  const bool ordered =
      (setPoint.value > 0 && demand >= kReversal) || (setPoint.value < 0 && demand <= -kReversal);
  const bool waits = ordered && applied_ == Tension();
  waitingCycles_ = waits ? static_cast<std::uint8_t>(waitingCycles_ + 1) : std::uint8_t{0};
  reversalLate_ = reversalLate_ || waitingCycles_ > kMostWaiting;
}

Tension UsualDesign::calculate(const WheelSetPoint& setPoint, Velocity velocity, Current current) {
  switch (setPoint.quantity) {
    case WheelQuantity::Velocity:
      return velocityTension(setPoint.value, velocity, current);
    case WheelQuantity::Current:
      return currentTension(setPoint.value, velocity, current);
    case WheelQuantity::Tension:
      break;
  }
  return Tension(setPoint.value);
}

Tension UsualDesign::velocityTension(std::int16_t setPoint, Velocity velocity, Current current) {
  std::int64_t expected = velocity.count() * kThousand;
  if (model_) {
    const std::int64_t goal = velocitySetPoint_ * kThousand;
    const std::int64_t deviation = *model_ - goal;
    expected = goal + deviation * kMean / kThousand;
    model_ = goal + deviation * kDecay / kThousand;
  } else {
    model_ = expected;
  }
  velocitySetPoint_ = setPoint;
  const std::int64_t unloaded =
      std::int64_t{kConstants.motorConstant().count()} * setPoint / kThousand;
  usedVelocity_ = doubtful(velocity, current)
                      ? Velocity(static_cast<std::int32_t>(expected / kThousand))
                      : velocity;
  const std::int64_t error = expected / kThousand - usedVelocity_.count();
  return Tension(static_cast<std::int32_t>(unloaded)) +
         velocityRegulator_.regulate(static_cast<std::int32_t>(error));
}

bool UsualDesign::doubtful(Velocity velocity, Current current) {
  if (!velocityApplied_) {
    return false;
  }
  constexpr auto kPerMille = static_cast<std::int32_t>(kThousand);
  const std::int32_t turning = kConstants.motorConstant().count() * velocity.count() / kPerMille;
  const std::int32_t winding = kWinding * current.count() / kPerMille;
  const std::int32_t made = velocityApplied_->count() - winding;
  const std::int32_t missing = made > 0 ? made - turning : turning - made;
  const std::int32_t greatest = std::max(std::abs(velocityApplied_->count()), std::abs(winding));
  if (missing <= kDoubt + greatest / kDoubtShare) {
    doubts_ = 0;
    return false;
  }
  if (doubts_ == kMostDoubts) {
    return false;
  }
  ++doubts_;
  return true;
}

Tension UsualDesign::currentTension(std::int16_t setPoint, Velocity velocity, Current current) {
  Tension correction;
  Velocity foreseen = velocity;
  if (velocityBefore_) {
    correction = currentRegulator_.regulate(currentSetPoint_ - current.count());
    foreseen = velocity * 2 - *velocityBefore_;
  }
  velocityBefore_ = velocity;
  currentSetPoint_ = setPoint;
  constexpr auto kPerMille = static_cast<std::int32_t>(kThousand);
  const Tension winding(kWinding * setPoint / kPerMille);
  const Tension turning(kConstants.motorConstant().count() * foreseen.count() / kPerMille);
  return winding + turning + correction;
}

void UsualDesign::apply(Tension demand, Velocity velocity) {
  const Tension before = applied_.value_or(Tension());
  if (backwards_ ? demand >= kSlight : demand <= -kSlight) {
    const bool along = demand > Tension() ? velocity > Velocity() : velocity < Velocity();
    const bool braked = brakedCycles_ == kBrakedCycles;
    if (!isSlow(velocity, braked ? kCreep : kConstants.slow()) && !along) {
      slowCycles_ = 0;
    } else if (slowCycles_ < kSlowCycles) {
      ++slowCycles_;
    }
    if (slowCycles_ < kSlowCycles || before != Tension()) {
      if (before == Tension() && brakedCycles_ < kBrakedCycles) {
        ++brakedCycles_;
      }
      const Tension left = before - std::clamp(before, -kFall, kFall);
      setTension(left);
      applied_ = left;
      return;
    }
    backwards_ = !backwards_;
    devices_.orientation.set(backwards_);
  } else {
    demand = backwards_ ? std::min(demand, Tension()) : std::max(demand, Tension());
  }
  slowCycles_ = 0;
  brakedCycles_ = 0;
  const Tension most = std::max(before, Tension()) + kRise;
  const Tension least = std::min(before, Tension()) - kRise;
  applied_ = std::clamp(demand, least, most);
  setTension(*applied_);
}

void UsualDesign::lower() {
  slowCycles_ = 0;
  const Tension before = applied_.value_or(Tension());
  const Tension left = before - std::clamp(before, -kFall, kFall);
  setTension(left);
  applied_ = left;
  resetAlgorithms();
}

void UsualDesign::driverOff() {
  devices_.pwm.set(DutyCycle());
  if (trip_.load() == Trip::Tripped) {
    trip_.store(Trip::Decaying);
  } else if (trip_.load() == Trip::Decaying) {
    trip_.store(Trip::Braking);
    enableDriver(Trip::Braking);
  }
  slowCycles_ = 0;
  waitingCycles_ = 0;
  resetAlgorithms();
  applied_.reset();
}

void UsualDesign::resetAlgorithms() {
  velocityRegulator_.reset();
  model_.reset();
  velocityApplied_.reset();
  doubts_ = 0;
  currentRegulator_.reset();
  velocityBefore_.reset();
}

void UsualDesign::setTension(Tension tension) {
  if (trip_.load() != Trip::None) {
    return;
  }
  const std::int32_t supply = kConstants.supply().count();
  const std::int32_t magnitude = std::min(std::abs(tension.count()), supply);
  devices_.pwm.set(DutyCycle((magnitude * kWholeDuty + supply / 2) / supply));
  enableDriver(Trip::None);
}

void UsualDesign::enableDriver(Trip permitted) {
  if (trip_.load() == permitted) {
    devices_.enable.set(true);
  }
  if (trip_.load() !=
      permitted) {  // the interrupt may have occurred before the driver was switched on
    devices_.enable.set(false);
  }
}

}  // namespace wr
