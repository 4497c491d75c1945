#pragma once

#include <array>

#include "bluetooth/Bluetooth.hpp"
#include "bluetooth/RandomSource.hpp"
#include "bluetooth/SignedPort.hpp"
#include "bluetooth/SipHash.hpp"
#include "communication/pc_connection/Connected.hpp"
#include "communication/pc_connection/Disconnected.hpp"
#include "communication/pc_connection/Handshaking.hpp"
#include "communication/pc_connection/PcConnection.hpp"
#include "communication/serialization/Reader.hpp"
#include "communication/serialization/SerialReader.hpp"
#include "devices/SerialPort.hpp"
#include "devices/Timebase.hpp"
#include "main_control/operation_modes/BasicMode.hpp"
#include "main_control/operation_modes/PC.hpp"
#include "safety/PersistentStop.hpp"
#include "safety/StopMemory.hpp"
#include "services/StartRecord.hpp"

namespace wr {

/// @brief Memories of the stop orders, one memory for each source of orders. A reset does not
/// clear these memories.
/// @datatype
struct BluetoothStops {
  StopMemory& pc;      ///< stop order of the PC
  StopMemory& device;  ///< stop order of the Bluetooth device
};

/// @brief The devices and the data that a Bluetooth connection needs.
/// @datatype
struct BluetoothDevices {
  SerialPort& port;      ///< serial port of the Bluetooth module
  SipHash::Key key;      ///< key that the device shares with the robot
  RandomSource& random;  ///< returns the random number that identifies this start of the firmware
  const Timebase& timebase;  ///< returns the present time
  const StartRecord& start;  ///< cause of the last reset
  BluetoothStops stops;      ///< memories of the stop orders
};

/// @brief The two reading modes of a robot that receives orders from the PC and a Bluetooth device.
/// Each of the two modes changes to the other mode.
/// @datatype
struct BluetoothModes {
  /// @brief Connects the modes to the sources of their orders.
  /// @param pcReader reader of the PC's orders
  /// @param pcConnection link to the PC
  /// @param devices devices of the Bluetooth connection
  BluetoothModes(Reader& pcReader, PcConnection& pcConnection, const BluetoothDevices& devices)
      : port(devices.port, devices.key, devices.random),
        handshaking(connected, disconnected),
        disconnected(handshaking),
        connected(handshaking, disconnected),
        connection(port, reader, disconnected, devices.start),
        basicPc(pcReader),
        basicBluetooth(reader),
        stopOfPc(basicPc, devices.stops.pc),
        stopOfBluetooth(basicBluetooth, devices.stops.device),
        pc(stopOfPc, bluetooth, pcConnection),
        bluetooth(stopOfBluetooth, pc, connection, devices.timebase),
        all{&pc, &bluetooth} {}

  SerialReader reader;        ///< contains the newest order of the device
  SignedPort port;            ///< serial port to the device; the port authenticates frames
  Handshaking handshaking;    ///< state of the connection: a Welcome was sent to the device
  Disconnected disconnected;  ///< state of the connection: no device is connected
  Connected connected;        ///< state of the connection: the device is connected
  PcConnection connection;    ///< connection to the device; it uses the handshake of the PC link
  BasicMode basicPc;          ///< reads the orders of the PC
  BasicMode basicBluetooth;   ///< reads the orders of the device
  PersistentStop stopOfPc;    ///< keeps a stop order of the PC in force after a reset
  PersistentStop stopOfBluetooth;  ///< keeps a stop order of the device in force after a reset
  PC pc;                           ///< the reading mode PC
  Bluetooth bluetooth;             ///< the reading mode Bluetooth
  std::array<Mode*, 2> all;        ///< both reading modes
};

}  // namespace wr
