#pragma once

#include <optional>

#include "bluetooth/BluetoothModes.hpp"
#include "construction/ControlSystemPoolBuilder.hpp"
#include "construction/MainControllerBuilder.hpp"
#include "devices/SerialPort.hpp"
#include "devices/Timebase.hpp"

namespace wr {

/// @brief The director that builds and starts a robot with two sources of orders: the PC and a
/// Bluetooth device.
///
/// @function Calls the steps of the builders in the required sequence. Passes the reading modes PC
/// and Bluetooth to the builder of the main controller, instead of the standard modes PC and RC.
/// Starts the control systems and the main controller.
///
/// @secret The steps that build a robot with a Bluetooth device and without a remote control.
///
/// @role{pool-construction, Director}
/// @role{main-controller-construction, Director}
class BluetoothDirector final {
 public:
  /// @param poolBuilder builds the control systems
  /// @param controllerBuilder builds the main controller
  /// @param devices devices of the Bluetooth connection
  BluetoothDirector(ControlSystemPoolBuilder& poolBuilder, MainControllerBuilder& controllerBuilder,
                    const BluetoothDevices& devices);

  BluetoothDirector(const BluetoothDirector&) = delete;
  BluetoothDirector& operator=(const BluetoothDirector&) = delete;

  /// @brief Builds the control systems and the main controller. The first reading mode is PC.
  /// @post start() can be called.
  /// @errors A second call ends the program with the assertion PartBuiltTwice.
  /// @satisfies FR-150
  /// @satisfies NFR-1
  /// @isr{no}
  void construct();

  /// @brief Starts the control cycles.
  /// @pre construct() was called.
  /// @errors If construct() was not called, the program ends with the assertion PartMissing.
  /// @satisfies FR-150
  /// @isr{no}
  void start();

 private:
  ControlSystemPoolBuilder& poolBuilder_;
  MainControllerBuilder& controllerBuilder_;
  BluetoothDevices devices_;
  std::optional<BluetoothModes> modes_;
};

}  // namespace wr
