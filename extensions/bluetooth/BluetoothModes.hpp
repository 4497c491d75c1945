#pragma once

#include <array>

#include "bluetooth/Bluetooth.hpp"
#include "bluetooth/BluetoothLink.hpp"
#include "communication/pc_connection/PcConnection.hpp"
#include "communication/serialization/Reader.hpp"
#include "communication/serialization/SerialReader.hpp"
#include "devices/SerialPort.hpp"
#include "devices/Timebase.hpp"
#include "main_control/operation_modes/BasicMode.hpp"
#include "main_control/operation_modes/PC.hpp"

namespace wr {

/// @brief The reading modes of a robot that the PC and a Bluetooth device command; each is the successor
/// of the other.
/// @datatype
struct BluetoothModes {
  /// @brief Makes the modes.
  /// @param pcReader reader of the PC's orders
  /// @param connection link to the PC
  /// @param port line to the Bluetooth module
  /// @param timebase gives the time
  BluetoothModes(Reader& pcReader, PcConnection& connection, SerialPort& port,
                 const Timebase& timebase)
      : link(port, reader, timebase),
        basicPc(pcReader),
        basicBluetooth(reader),
        pc(basicPc, bluetooth, connection),
        bluetooth(basicBluetooth, pc, link),
        all{&pc, &bluetooth} {}

  SerialReader reader;       ///< newest order of the device
  BluetoothLink link;        ///< line to the device
  BasicMode basicPc;         ///< what PC extends
  BasicMode basicBluetooth;  ///< what Bluetooth extends
  PC pc;                     ///< reads from the PC
  Bluetooth bluetooth;       ///< reads from the device
  std::array<Mode*, 2> all;  ///< both modes
};

}  // namespace wr
