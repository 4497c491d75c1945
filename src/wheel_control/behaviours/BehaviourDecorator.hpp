#pragma once

#include "wheel_control/behaviours/WheelBehaviour.hpp"

namespace wr {

/// @brief A behaviour that extends another behaviour.
///
/// @function Forwards each operation to the wrapped behaviour, unless a subclass extends it.
///
/// @secret Which operations of the wrapped behaviour are forwarded unchanged.
///
/// @role{behaviour-extensions, Decorator}
///
/// @patternapp{behaviour-extensions, Decorator, Algorithm extensions to establish the wheels' behaviour}
/// @why Some movements of a wheel combine or extend simpler movements: a reversal is a stop, and
/// then an advance in the other orientation.
/// @changes An extension may change, or a new extension may be needed, without change to the extended
/// behaviour.
class BehaviourDecorator : public WheelBehaviour {
 public:
  Tension apply(Tension demand, Velocity velocity) override;
  void resume(Tension applied) override;

 protected:
  /// @brief Binds the decorator to the behaviour that it extends.
  /// @param wrapped the extended behaviour
  explicit BehaviourDecorator(WheelBehaviour& wrapped);
  ~BehaviourDecorator() = default;

 private:
  WheelBehaviour& wrapped_;
};

}  // namespace wr
