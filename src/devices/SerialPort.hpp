#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "units/quantities.hpp"

namespace wr {

/// @brief Serial line in both directions.
/// @function Stores received bytes until they are read, and written bytes until they are sent.
/// @secret How bytes travel between the line and the storage of the port.
class SerialPort {
 public:
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  /// @brief Reads received bytes, oldest first, up to and including the first zero byte. Never waits.
  /// @param bytes where the bytes are stored
  /// @return number of stored bytes; 0 only when no byte was received, or when there is no place
  /// @isr{no}
  virtual std::size_t read(std::span<std::uint8_t> bytes) = 0;

  /// @brief Returns when the zero byte that ended the last read was received.
  /// @return time of its stop bit. A zero byte after another one may have the time of that one.
  /// @pre The last read ended with a zero byte.
  /// @isr{no}
  /// @satisfies FR-20
  /// @satisfies FR-33
  [[nodiscard]] virtual Instant receivedAt() const = 0;

  /// @brief Returns the room for bytes to send.
  /// @return number of bytes that a write can take now
  /// @isr{no}
  /// @satisfies FR-64
  [[nodiscard]] virtual std::size_t free() const = 0;

  /// @brief Passes bytes to the port to send, all or none. Never waits.
  /// @param bytes bytes to send
  /// @return false when there is no room for all bytes: none is sent
  /// @isr{no}
  /// @satisfies FR-64
  virtual bool write(std::span<const std::uint8_t> bytes) = 0;

  /// @brief Returns the number of bytes that were received and not stored.
  /// @return number of lost bytes since start, at most 65535
  /// @isr{no}
  /// @satisfies FR-49
  [[nodiscard]] virtual std::uint16_t lostBytes() const = 0;

 protected:
  SerialPort() = default;
  ~SerialPort() = default;
};

}  // namespace wr
