#pragma once

#include "main_control/operation_modes/ModeDecorator.hpp"
#include "safety/StopMemory.hpp"

namespace wr {

/// @brief A mode that keeps a stop order of its source in force after a reset.
///
/// @function When a stop begins or ends, stores this change in a memory that a reset does not
/// clear. If a stop was in force before a reset, it stays in force until the source sends neutral
/// set-points without a stop.
///
/// @secret The event that ends a stored stop after a reset.
///
/// @role{mode-extensions, Concrete Decorator}
class PersistentStop final : public ModeDecorator {
 public:
  /// @brief Reads from the memory whether a stop was in force before the reset. If it was in force,
  /// it stays in force.
  /// @param wrapped the mode that this mode wraps
  /// @param memory memory of the stop; a reset does not clear this memory
  PersistentStop(Mode& wrapped, StopMemory& memory);

  /// @brief Calls serve() of the wrapped mode, and stores whether a stop is in force.
  /// @satisfies FR-290
  /// @isr{no}
  void serve() override;

  /// @brief Reads an order. If the order is neutral and contains no stop, it ends the stop that was
  /// stored before the reset.
  /// @param mCtrl main controller that receives the set-points
  /// @satisfies FR-290
  /// @isr{no}
  void read(MainController& mCtrl) override;

  /// @brief Has no effect: only the outer mode, which wraps this object, changes the reading mode.
  /// @param mCtrl main controller whose reading mode does not change
  /// @isr{no}
  void changeMode(MainController& mCtrl) override;

  /// @brief Checks whether a stop of the source is in force.
  /// @return true if stopOrdered() of the wrapped mode returns true, or if the stop that was read
  /// from the memory after the reset is still in force.
  /// @satisfies FR-290
  /// @isr{no}
  [[nodiscard]] bool stopOrdered() const override;

 private:
  StopMemory& memory_;
  bool kept_;  // the stop that was read from the memory is still in force
};

}  // namespace wr
