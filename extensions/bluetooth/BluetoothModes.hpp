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

/// @brief The memories of the stops of both sources, which a reset does not clear.
/// @datatype
struct BluetoothStops {
  StopMemory& pc;      ///< stop of the PC
  StopMemory& device;  ///< stop of the Bluetooth device
};

/// @brief The devices of a Bluetooth connection.
/// @datatype
struct BluetoothDevices {
  SerialPort& port;          ///< line to the Bluetooth module
  SipHash::Key key;          ///< key that the device shares with the robot
  RandomSource& random;      ///< generator of the random number that identifies this start
  const Timebase& timebase;  ///< returns the time
  const StartRecord& start;  ///< cause of the start of the firmware
  BluetoothStops stops;      ///< memories of the stops
};

/// @brief The reading modes of a robot that receives orders from the PC and a Bluetooth device; each is the successor
/// of the other.
/// @datatype
struct BluetoothModes {
  /// @brief Binds the modes to their sources.
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

  SerialReader reader;             ///< newest order of the device
  SignedPort port;                 ///< line to the device, with authenticated frames
  Handshaking handshaking;         ///< a Welcome was sent to the device
  Disconnected disconnected;       ///< no device is connected
  Connected connected;             ///< the device is connected
  PcConnection connection;         ///< connection to the device, with the handshake of the PC
  BasicMode basicPc;               ///< basic mode of the PC
  BasicMode basicBluetooth;        ///< basic mode of the device
  PersistentStop stopOfPc;         ///< keeps the stop of the PC during a reset
  PersistentStop stopOfBluetooth;  ///< keeps the stop of the device during a reset
  PC pc;                           ///< reads from the PC
  Bluetooth bluetooth;             ///< reads from the device
  std::array<Mode*, 2> all;        ///< both modes
};

}  // namespace wr
