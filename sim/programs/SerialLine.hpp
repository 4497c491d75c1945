#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace wr::programs {

/// @brief The end of a serial line on this computer. The other end is a serial port of the robot.
/// The methods do not block.
class SerialLine {
 public:
  SerialLine() = default;
  SerialLine(const SerialLine&) = delete;
  SerialLine& operator=(const SerialLine&) = delete;
  virtual ~SerialLine() = default;

  /// @brief Returns the name with which a client can open the serial line.
  [[nodiscard]] virtual const std::string& name() const = 0;

  /// @brief Reads bytes that a client has sent.
  /// @param bytes receives the bytes
  /// @return number of bytes; 0 if there are no bytes
  virtual std::size_t read(std::span<std::uint8_t> bytes) = 0;

  /// @brief Sends bytes to the client.
  /// @param bytes the bytes
  /// @return false if bytes are lost because no client reads the serial line
  virtual bool write(std::span<const std::uint8_t> bytes) = 0;
};

/// @brief Opens a serial line. Throws std::system_error when this fails.
/// @param kind "pty", "stdout" or "tcp:PORT"; see isLineKind()
/// @return the serial line
[[nodiscard]] std::unique_ptr<SerialLine> openLine(const std::string& kind);

/// @brief Checks whether openLine() supports a kind of serial line.
[[nodiscard]] bool isLineKind(const std::string& kind);

}  // namespace wr::programs
