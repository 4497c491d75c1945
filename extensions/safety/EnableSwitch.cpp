#include "safety/EnableSwitch.hpp"

#include <optional>

#include "main_control/MainController.hpp"
#include "services/SystemConstants.hpp"

namespace wr {

namespace {

// Limits of the pulse widths for the positions of the enable switch. A width between the ranges of
// two positions does not change the position.
constexpr Microseconds kMinPcPulse(1350);
constexpr Microseconds kMaxPcPulse(1650);
constexpr Microseconds kMinDrivePulse(1750);

constexpr Microseconds kLifetime = milliseconds(200);  // greatest age of a valid pulse

// After the switch has moved through the positions "stop", "PC" and "drive", this number of orders
// can acknowledge faults.
constexpr std::uint8_t kAcknowledgements = 3;

// These orders acknowledge faults only within this time after the movement. A later acknowledgement
// needs a new movement through these positions.
constexpr Microseconds kAcknowledgeTime = milliseconds(1000);

constexpr std::int32_t kFullDeflection = 500;  // [us] greatest deflection of a stick

// Returns the deflection of a stick [us], rounded to the nearest integer. The value of the stick
// was computed from the deflection of a pulse, and was rounded. One microsecond of deflection
// changes the value by several units. Therefore the rounding of the value does not change the
// result: it is the deflection of this pulse, except in the neutral range and beyond full
// deflection.
std::int32_t deflectionOf(std::int32_t value, std::int32_t limit) {
  const std::int32_t half = value < 0 ? -limit / 2 : limit / 2;
  return (value * kFullDeflection + half) / limit;
}

// Returns whether a pulse shows that the switch is in the position "stop".
bool showsStop(Microseconds width) {
  return width >= EnableSwitch::kShortestPulse && width < EnableSwitch::kMinNoStopPulse;
}

bool fresh(Instant at, Instant now) {
  return now - at <= kLifetime;
}

}  // namespace

EnableSwitch::EnableSwitch(Mode& wrapped, const Signals& signals)
    : ModeDecorator(ModeId::None, wrapped), signals_(signals) {}

void EnableSwitch::serve() {
  const Instant now = signals_.timebase.now();
  takePosition(now);
  advanceSequence(now);
  if (position_ == Position::Stop || unattended(now)) {
    stopped_ = true;
  } else if (!deflected(now)) {
    stopped_ = false;
  }
  ModeDecorator::serve();
}

bool EnableSwitch::newMessage() const {
  return position_ != Position::Pc && ModeDecorator::newMessage();
}

void EnableSwitch::read(MainController& mCtrl) {
  ModeDecorator::read(mCtrl);
  const std::optional<SetPoints>& read = mCtrl.getData().setPoints();
  if (read && acknowledgements_ > 0 && !stopped_) {
    SetPoints acknowledging = *read;
    acknowledging.acknowledge = true;
    mCtrl.getData().saveSetPoints(acknowledging);
    --acknowledgements_;
  }
}

void EnableSwitch::changeMode(MainController& /*mCtrl*/) {}

bool EnableSwitch::stopOrdered() const {
  return stopped_ || ModeDecorator::stopOrdered();
}

EnableSwitch::Position EnableSwitch::positionOf(Microseconds width, Position before) {
  if (width < kMinNoStopPulse) {
    return Position::Stop;
  }
  if (width >= kMinDrivePulse) {
    return Position::Drive;
  }
  return width >= kMinPcPulse && width <= kMaxPcPulse ? Position::Pc : before;
}

void EnableSwitch::takePosition(Instant now) {
  const std::optional<Stamped<Microseconds>> pulse = signals_.enable.read();
  const bool confirmed = stopConfirmed();
  if (!confirmed && pulse && fresh(pulse->at, now)) {
    position_ = positionOf(pulse->value, position_);
  } else {
    position_ = Position::Stop;
  }
}

// Returns whether two successive pulses have ordered a stop since the last cycle.
bool EnableSwitch::stopConfirmed() {
  const std::optional<Stamped<Microseconds>> pulse = signals_.stop.read();
  confirmed_.reset();
  if (pulse && pulse->at != confirmedAt_) {
    confirmed_ = pulse->value;
    confirmedAt_ = pulse->at;
  }
  return confirmed_.has_value();
}

// Records the progress of the switch through the positions "stop", "PC" and "drive". Only an
// operator moves the switch through the position "PC": when the radio link returns, the output of
// the receiver changes directly from "stop" to "drive". Missing pulses and pulses out of their
// range also stop the robot, but they do not show that the switch is in the position "stop".
// Therefore they end the sequence.
void EnableSwitch::advanceSequence(Instant now) {
  const std::optional<Stamped<Microseconds>> pulse = signals_.enable.read();
  if (now - drivenAt_ > kAcknowledgeTime) {
    acknowledgements_ = 0;
  }
  if (!pulse || !fresh(pulse->at, now)) {
    sequence_ = Sequence::None;
    acknowledgements_ = 0;
  } else if (position_ == Position::Stop) {
    if (showsStop(pulse->value) || (confirmed_ && showsStop(*confirmed_))) {
      sequence_ = Sequence::Stopped;
    } else if (confirmed_) {
      sequence_ = Sequence::None;
    }
    acknowledgements_ = 0;
  } else if (position_ == Position::Pc) {
    sequence_ = sequence_ == Sequence::None ? Sequence::None : Sequence::Passed;
  } else {
    if (sequence_ == Sequence::Passed) {
      acknowledgements_ = kAcknowledgements;
      drivenAt_ = now;
    }
    sequence_ = Sequence::None;
  }
}

bool EnableSwitch::deflected(Instant now) {
  const std::optional<Stamped<Velocity>> velocity = signals_.velocity.read();
  return velocity && fresh(velocity->at, now) && velocity->value != Velocity();
}

bool EnableSwitch::unattended(Instant now) {
  const std::int32_t velocity =
      signals_.velocity.read().value_or(Stamped<Velocity>()).value.count();
  const std::int32_t direction = signals_.direction.read().value_or(Stamped<Angle>()).value.count();
  const std::int64_t enable =
      signals_.enable.read().value_or(Stamped<Microseconds>()).value.count();
  const SystemConstants& constants = SystemConstants::instance();
  const RcVigilance::Deflections deflections{
      deflectionOf(velocity, constants.velocityLimit().count()),
      deflectionOf(direction, constants.steeringLimit().count()),
      static_cast<std::int32_t>(enable)};
  const bool moving = position_ == Position::Drive && !stopped_ && deflected(now);
  return vigilance_.expired(deflections, moving, now);
}

}  // namespace wr
