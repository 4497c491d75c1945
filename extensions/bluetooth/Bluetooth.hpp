#pragma once

#include "communication/pc_connection/PcConnection.hpp"
#include "devices/Timebase.hpp"
#include "main_control/operation_modes/ModeDecorator.hpp"

namespace wr {

/// @brief The reading mode in which a Bluetooth device commands the robot.
///
/// @function Extends the basic mode: an order is valid only while the Bluetooth device is
/// connected. When an order is read, Bluetooth is recorded as the source of the set-points. Selects
/// the other reading mode at the request of the operation state.
///
/// @secret The form in which a Bluetooth device is recorded as the source of set-points.
///
/// @role{reading-modes, Concrete State}
/// @role{mode-extensions, Concrete Decorator}
class Bluetooth final : public ModeDecorator {
 public:
  /// @brief Number of this mode in reports.
  static constexpr ModeId kId{2};

  /// @param wrapped mode that this mode wraps; it reads the orders of the device
  /// @param other mode that changeMode() selects; it need not be constructed before the first call
  /// of changeMode()
  /// @param connection connection to the device
  /// @param timebase returns the present time
  Bluetooth(Mode& wrapped, Mode& other, PcConnection& connection, const Timebase& timebase);

  /// @brief Processes the input of the connection, then calls serve() of the wrapped mode.
  /// @satisfies FR-151
  /// @isr{no}
  void serve() override;

  /// @brief Checks whether the device is connected and has an order that can be read now.
  /// @return true if the device is connected and the wrapped mode has a message.
  /// @satisfies FR-150
  /// @satisfies FR-260
  /// @isr{no}
  [[nodiscard]] bool newMessage() const override;

  /// @brief Records Bluetooth as the source of the set-points, then calls read() of the wrapped
  /// mode.
  /// @param mCtrl main controller that receives the set-points and their source
  /// @pre newMessage() returned true in this cycle.
  /// @post The order cannot be read again.
  /// @satisfies FR-150
  /// @isr{no}
  void read(MainController& mCtrl) override;

  /// @brief Sets the reading mode of the main controller to the other mode.
  /// @param mCtrl main controller whose reading mode changes
  /// @satisfies FR-150
  /// @isr{no}
  void changeMode(MainController& mCtrl) override;

 private:
  Mode& other_;
  PcConnection& connection_;
  const Timebase& timebase_;
};

}  // namespace wr
