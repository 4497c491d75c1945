#pragma once

#include "main_control/operation_modes/ModeDecorator.hpp"
#include "safety/StopMemory.hpp"

namespace wr {

/// @brief Keeps the stop of a source during a reset.
///
/// @function Stores the stop of the wrapped mode in every cycle. A stop that was in force before a
/// reset stays in force until the source orders neutral set-points without a stop.
///
/// @secret The event that ends a stop that was stored before a reset.
///
/// @role{mode-extensions, Concrete Decorator}
class PersistentStop final : public ModeDecorator {
 public:
  /// @brief Binds the decorator to the mode and to the memory of its stop.
  /// @param wrapped the extended mode
  /// @param memory memory of the stop
  PersistentStop(Mode& wrapped, StopMemory& memory);

  /// @brief Serves the wrapped mode, and stores its stop.
  /// @satisfies FR-290
  /// @isr{no}
  void serve() override;

  /// @brief Reads an order; a neutral order ends a stop that was stored before the reset.
  /// @param mCtrl controller whose data receive the set-points
  /// @satisfies FR-290
  /// @isr{no}
  void read(MainController& mCtrl) override;

  /// @brief Has no effect: the mode that wraps this mode changes the reading mode.
  /// @param mCtrl controller whose mode stays
  /// @isr{no}
  void changeMode(MainController& mCtrl) override;

  /// @brief Checks whether the source orders a stop.
  /// @return true if the source orders a stop, or if its stop from before the reset is still in
  /// force.
  /// @satisfies FR-290
  /// @isr{no}
  [[nodiscard]] bool stopOrdered() const override;

 private:
  StopMemory& memory_;
  bool kept_;  // a stop was ordered before the reset
};

}  // namespace wr
