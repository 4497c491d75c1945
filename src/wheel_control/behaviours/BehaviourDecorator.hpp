#pragma once

#include "wheel_control/behaviours/WheelBehaviour.hpp"

namespace wr {

/// @brief A behaviour that extends another behaviour.
///
/// @function Forwards each call to the wrapped behaviour. A subclass overrides the operations that
/// it extends.
///
/// @secret The operations that are forwarded to the wrapped behaviour unchanged.
///
/// @role{behaviour-extensions, Decorator}
///
/// @patternapp{behaviour-extensions, Decorator, Algorithm extensions to establish the wheels' behaviour}
/// @why Some movements of a wheel combine or extend simpler movements. For example, a reversal is a
/// stop that is followed by an advance in the other orientation.
/// @changes An extension may change, or a new extension may be needed. The extended behaviour does
/// not change.
class BehaviourDecorator : public WheelBehaviour {
 public:
  Tension apply(Tension demand, Velocity velocity) override;
  void resume(Tension applied) override;

 protected:
  /// @param wrapped the extended behaviour
  explicit BehaviourDecorator(WheelBehaviour& wrapped);
  ~BehaviourDecorator() = default;

 private:
  WheelBehaviour& wrapped_;
};

}  // namespace wr
