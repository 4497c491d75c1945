#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "units/quantities.hpp"

namespace wr {

/// @brief Port of a serial line, for sending and receiving bytes.
/// @function Stores received bytes until the firmware reads them. Stores written bytes until the
/// port has sent them.
/// @secret The method by which bytes are transferred between the serial line and the buffers of the
/// port.
class SerialPort {
 public:
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  /// @brief Reads received bytes, the oldest byte first. Stops after the first zero byte, which is
  /// read too. Never waits. A port may drop a zero byte that follows another zero byte, because the
  /// second zero byte ends no frame.
  /// @param bytes buffer into which the bytes are written
  /// @return number of bytes that were written into the buffer; 0 only when there is no received
  /// byte to read, or when the buffer has the size 0
  /// @isr{no}
  virtual std::size_t read(std::span<std::uint8_t> bytes) = 0;

  /// @brief Returns the time at which the port received the zero byte that ended the last read.
  /// @return time of the stop bit of this zero byte
  /// @pre The last read ended with a zero byte.
  /// @isr{no}
  /// @satisfies FR-20
  /// @satisfies FR-33
  [[nodiscard]] virtual Instant receivedAt() const = 0;

  /// @brief Returns the free space in the transmit buffer.
  /// @return number of bytes that write() can accept now
  /// @isr{no}
  /// @satisfies FR-64
  [[nodiscard]] virtual std::size_t free() const = 0;

  /// @brief Passes bytes to the port, which sends them in the background. Accepts either all bytes
  /// or no byte. Never waits.
  /// @param bytes bytes to send
  /// @return true when all bytes were accepted; false when there is not enough space: then no byte
  /// is sent
  /// @isr{no}
  /// @satisfies FR-64
  virtual bool write(std::span<const std::uint8_t> bytes) = 0;

  /// @brief Returns the number of bytes that were received but not stored.
  /// @return number of lost bytes since start, at most 65535
  /// @isr{no}
  /// @satisfies FR-49
  [[nodiscard]] virtual std::uint16_t lostBytes() const = 0;

 protected:
  SerialPort() = default;
  ~SerialPort() = default;
};

}  // namespace wr
