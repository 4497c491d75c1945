#pragma once

#include "communication/serialization/Reader.hpp"
#include "main_control/operation_modes/Mode.hpp"

namespace wr {

/// @brief The part of reading that is the same for every source.
///
/// @function Reads one order from a Reader and saves its set-points. The modes wrap it and add the
/// particular behaviour of their source.
///
/// @secret That the set-points of every source travel as one OrderMessage.
///
/// @role{mode-extensions, Concrete Component}
class BasicMode final : public Mode {
 public:
  /// @brief Binds the mode to the reader of its source.
  /// @param reader where the orders of the source are read
  explicit BasicMode(Reader& reader);

  /// @brief Does nothing: the reader of the basic task has its input at once.
  /// @isr{no}
  void serve() override;

  /// @brief Returns whether the reader holds an order that can be read now.
  /// @return true if the order is the newest of its source, young enough, and was not read before.
  /// @satisfies FR-20
  /// @isr{no}
  [[nodiscard]] bool newMessage() const override;

  /// @brief Reads the order and saves its set-points in the data of the controller.
  /// @param mCtrl controller whose data takes the set-points
  /// @pre newMessage() was true in this cycle.
  /// @post The order is consumed.
  /// @errors An order that cannot be read whole leaves the set-points as they were.
  /// @satisfies FR-20
  /// @isr{no}
  void read(MainController& mCtrl) override;

  /// @brief Changes nothing: the basic part has no other mode.
  /// @param mCtrl controller, left as it is
  /// @isr{no}
  void changeMode(MainController& mCtrl) override;

  [[nodiscard]] bool stopOrdered() const override;

 private:
  Reader& reader_;
};

}  // namespace wr
