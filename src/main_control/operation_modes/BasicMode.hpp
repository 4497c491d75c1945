#pragma once

#include "communication/serialization/Reader.hpp"
#include "main_control/operation_modes/Mode.hpp"

namespace wr {

/// @brief The reading mode with the steps that are the same for every source of orders.
///
/// @function Reads one order from a Reader and saves the set-points of the order. The other modes
/// wrap a basic mode or another mode. They add the behaviour that only their sources need.
///
/// @secret The object into which an order of any source is read: an OrderMessage.
///
/// @role{mode-extensions, Concrete Component}
class BasicMode final : public Mode {
 public:
  /// @param reader reader of the orders of the source
  explicit BasicMode(Reader& reader);

  /// @brief Does nothing, because the reader needs no service.
  /// @isr{no}
  void serve() override;

  /// @brief Returns whether the reader has an order that can be read now.
  /// @return true if the newest order of the source is not too old and was not read before.
  /// @satisfies FR-20
  /// @isr{no}
  [[nodiscard]] bool newMessage() const override;

  /// @brief Reads the order and saves its set-points in the data of the controller.
  /// @param mCtrl controller whose data receive the set-points
  /// @pre newMessage() was true in this cycle.
  /// @post The order cannot be read again.
  /// @errors If the order cannot be read completely, the set-points do not change.
  /// @satisfies FR-20
  /// @isr{no}
  void read(MainController& mCtrl) override;

  /// @brief Does nothing, because the basic mode has no successor.
  /// @param mCtrl is not used
  /// @isr{no}
  void changeMode(MainController& mCtrl) override;

  [[nodiscard]] bool stopOrdered() const override;

 private:
  Reader& reader_;
};

}  // namespace wr
