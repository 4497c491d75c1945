#pragma once

#include "main_control/operation_modes/Mode.hpp"

namespace wr {

/// @brief A mode that extends another mode.
///
/// @function Forwards each operation to the wrapped mode, unless a subclass extends it. Subclasses
/// define the operations that they extend.
///
/// @secret Which operations of the wrapped mode are forwarded unchanged.
///
/// @role{mode-extensions, Decorator}
///
/// @patternapp{mode-extensions, Decorator, Operation modes as extensions of a basic task}
/// @why The source of the orders determines the mode. Reading has the same basic actions in each
/// mode, and each mode adds other actions to them.
/// @changes The additions of a mode to reading may change without change to the basic task. A new
/// reading mode is one more decorator around it.
class ModeDecorator : public Mode {
 public:
  void serve() override;
  [[nodiscard]] bool newMessage() const override;
  void read(MainController& mCtrl) override;
  [[nodiscard]] bool stopOrdered() const override;

 protected:
  /// @brief Binds the decorator to the mode that it extends.
  /// @param id number of the mode, as in reports
  /// @param wrapped the extended mode
  ModeDecorator(ModeId id, Mode& wrapped);
  ~ModeDecorator() = default;

 private:
  Mode& wrapped_;
};

}  // namespace wr
