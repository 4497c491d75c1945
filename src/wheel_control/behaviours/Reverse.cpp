#include "wheel_control/behaviours/Reverse.hpp"

#include <algorithm>

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr Tension kReverseDeadband(100);  // least voltage for which the orientation changes

constexpr std::uint8_t kSlowCycles = 2;  // successive slow cycles before a change of orientation

// A slope can keep a short-circuited wheel turning. After this number of cycles without voltage, a
// wheel below kCreepVelocity counts as slow.
constexpr std::uint8_t kBrakedCycles = 10;
constexpr Velocity kCreepVelocity(800);

bool isSlow(Velocity velocity, bool braked) {
  const Velocity slow = braked ? kCreepVelocity : SystemConstants::instance().slow();
  return velocity < slow && velocity > -slow;
}

// Returns whether a wheel already turns in the direction of a demand. Such a wheel need not slow
// down before its orientation changes.
bool turnsAlong(Tension demand, Velocity velocity) {
  return demand > Tension() ? velocity > Velocity() : velocity < Velocity();
}

}  // namespace

Reverse::Reverse(WheelBehaviour& wrapped, WheelBehaviour& stop, WheelCommand& setOrientation)
    : BehaviourDecorator(wrapped), stop_(stop), setOrientation_(setOrientation) {}

Tension Reverse::apply(Tension demand, Velocity velocity) {
  if (!opposes(demand)) {
    slowCycles_ = 0;
    brakedCycles_ = 0;
    applied_ = BehaviourDecorator::apply(agreeing(demand), velocity);
    return applied_;
  }
  if (!isSlow(velocity, brakedCycles_ == kBrakedCycles) && !turnsAlong(demand, velocity)) {
    slowCycles_ = 0;
  } else if (slowCycles_ < kSlowCycles) {
    ++slowCycles_;
  }
  if (!canTurn()) {
    if (applied_ == Tension() && brakedCycles_ < kBrakedCycles) {
      ++brakedCycles_;
    }
    applied_ = stop_.apply(applied_, velocity);
    BehaviourDecorator::resume(applied_);
    return applied_;
  }
  setOrientation_.execute(demand);
  backwards_ = !backwards_;
  slowCycles_ = 0;
  brakedCycles_ = 0;
  applied_ = BehaviourDecorator::apply(demand, velocity);
  return applied_;
}

void Reverse::resume(Tension applied) {
  applied_ = applied;
  slowCycles_ = 0;
  BehaviourDecorator::resume(applied);
}

bool Reverse::opposes(Tension demand) const {
  return backwards_ ? demand >= kReverseDeadband : demand <= -kReverseDeadband;
}

Tension Reverse::agreeing(Tension demand) const {
  return backwards_ ? std::min(demand, Tension()) : std::max(demand, Tension());
}

bool Reverse::canTurn() const {
  return slowCycles_ >= kSlowCycles && applied_ == Tension();
}

}  // namespace wr
