#pragma once

#include <cstdint>

#include "communication/framing/FrameDecoder.hpp"
#include "communication/serialization/SerialReader.hpp"
#include "devices/SerialPort.hpp"
#include "devices/Timebase.hpp"

namespace wr {

/// @brief The line to a Bluetooth device.
/// @function Takes orders out of the bytes of a Bluetooth module, in the frames of the PC protocol, and
/// gives them to their reader. There is no handshake: the device is paired by the module itself.
/// Nothing is sent.
/// @secret What a Bluetooth device sends, and that anything but an order is passed over.
class BluetoothLink final {
 public:
  /// @brief Binds the link to its line and its reader.
  /// @param port line to the Bluetooth module
  /// @param orders takes the orders
  /// @param clock gives the instant at which the age of an order is measured
  BluetoothLink(SerialPort& port, SerialReader& orders, const Timebase& clock);

  BluetoothLink(const BluetoothLink&) = delete;
  BluetoothLink& operator=(const BluetoothLink&) = delete;

  /// @brief Takes in all bytes that came, at most those of one cycle at 115200 baud.
  /// @isr{no}
  /// @satisfies FR-151
  /// @satisfies FR-179
  void receive();

 private:
  void take(const Frame& frame);

  SerialPort& port_;
  SerialReader& orders_;
  const Timebase& clock_;
  FrameDecoder decoder_;
};

}  // namespace wr
