#pragma once

#include "main_control/operation_modes/Mode.hpp"

namespace wr {

/// @brief A mode that extends another mode.
///
/// @function Forwards each call except changeMode() to the wrapped mode. A subclass defines
/// changeMode(), and overrides the operations that it extends.
///
/// @secret The operations that are forwarded to the wrapped mode unchanged.
///
/// @role{mode-extensions, Decorator}
///
/// @patternapp{mode-extensions, Decorator, Operation modes as extensions of a basic task}
/// @why The source of the orders determines the mode. An order is read by basic actions, which are
/// the same in each mode. Each mode adds other actions to these basic actions.
/// @changes A mode may add different actions. The basic actions do not change. A new reading mode
/// is one more decorator around the basic mode.
class ModeDecorator : public Mode {
 public:
  void serve() override;
  [[nodiscard]] bool newMessage() const override;
  void read(MainController& mCtrl) override;
  [[nodiscard]] bool stopOrdered() const override;

 protected:
  /// @param id number of the mode, as in reports
  /// @param wrapped the mode that this mode wraps
  ModeDecorator(ModeId id, Mode& wrapped);
  ~ModeDecorator() = default;

 private:
  Mode& wrapped_;
};

}  // namespace wr
