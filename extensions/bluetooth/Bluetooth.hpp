#pragma once

#include "communication/pc_connection/PcConnection.hpp"
#include "devices/Timebase.hpp"
#include "main_control/operation_modes/ModeDecorator.hpp"

namespace wr {

/// @brief The reading mode in which a Bluetooth device commands the robot.
///
/// @function Extends the basic mode: an order is valid only while the device is connected, and
/// Bluetooth is recorded as the source of its set-points. Changes to the other mode when the
/// operation state demands it.
///
/// @secret How a Bluetooth device is recorded as the source of set-points.
///
/// @role{reading-modes, Concrete State}
/// @role{mode-extensions, Concrete Decorator}
class Bluetooth final : public ModeDecorator {
 public:
  /// @brief Number of the mode, as in reports.
  static constexpr ModeId kId{2};

  /// @brief Binds the mode to the mode that it extends, to the mode that follows it and to its connection.
  /// @param wrapped basic mode that reads the orders of the device
  /// @param other mode to change to; only its address is used before the first changeMode()
  /// @param connection connection to the device
  /// @param timebase returns the time at which the connection is served
  Bluetooth(Mode& wrapped, Mode& other, PcConnection& connection, const Timebase& timebase);

  /// @brief Serves the connection to the device, then the wrapped mode.
  /// @satisfies FR-151
  /// @isr{no}
  void serve() override;

  /// @brief Checks whether the device is connected and has an order that can be read now.
  /// @return true if the device is connected and the wrapped mode has a message.
  /// @satisfies FR-150
  /// @satisfies FR-260
  /// @isr{no}
  [[nodiscard]] bool newMessage() const override;

  /// @brief Saves the mode id of Bluetooth, then lets the wrapped mode read.
  /// @param mCtrl controller whose data receive the set-points and the source
  /// @pre newMessage() was true in this cycle.
  /// @post The order cannot be read again.
  /// @satisfies FR-150
  /// @isr{no}
  void read(MainController& mCtrl) override;

  /// @brief Lets the controller read from the other mode.
  /// @param mCtrl controller whose mode changes
  /// @satisfies FR-150
  /// @isr{no}
  void changeMode(MainController& mCtrl) override;

 private:
  Mode& other_;
  PcConnection& connection_;
  const Timebase& timebase_;
};

}  // namespace wr
