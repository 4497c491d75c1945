#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "units/quantities.hpp"

namespace wr {

/// @brief Serial line in both directions.
/// @function Stores received bytes until they are read, and written bytes until they are sent.
/// @secret How bytes are transferred between the line and the buffers of the port.
class SerialPort {
 public:
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  /// @brief Reads received bytes, oldest first, at most up to and including the first zero byte. Never
  /// waits. A port may drop a zero byte that follows another zero byte: it ends no frame.
  /// @param bytes receives the bytes
  /// @return number of stored bytes; 0 only when no byte was received, or when the buffer of the
  /// caller is empty
  /// @isr{no}
  virtual std::size_t read(std::span<std::uint8_t> bytes) = 0;

  /// @brief Returns the time at which the zero byte that ended the last read was received.
  /// @return time of its stop bit
  /// @pre The last read ended with a zero byte.
  /// @isr{no}
  /// @satisfies FR-20
  /// @satisfies FR-33
  [[nodiscard]] virtual Instant receivedAt() const = 0;

  /// @brief Returns the free space for bytes to send.
  /// @return number of bytes that a write can accept now
  /// @isr{no}
  /// @satisfies FR-64
  [[nodiscard]] virtual std::size_t free() const = 0;

  /// @brief Passes bytes to the port to send, all or none. Never waits.
  /// @param bytes bytes to send
  /// @return false when there is no space for all bytes: no byte is sent
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
