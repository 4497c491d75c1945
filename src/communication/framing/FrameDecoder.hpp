#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "communication/framing/Frame.hpp"

namespace wr {

/// @brief The result of bytes from the line.
/// @datatype
enum class Decoded : std::uint8_t {
  Nothing,        ///< no frame has ended
  Whole,          ///< a frame without an error
  Damaged,        ///< a frame with bad COBS or CRC or less than 5 bytes
  TooLong,        ///< a frame with a body of more than 205 bytes
  UnknownVersion  ///< a frame of another protocol version
};

/// @brief Extracts frames from the bytes of the line.
/// @function Collects bytes until a frame ends, and checks whether the frame has an error. After
/// any
/// damage it finds the next frame.
/// @secret How a frame is collected and checked, and how the decoder finds the next frame after
/// damage.
class FrameDecoder final {
 public:
  /// @brief Constructs a decoder that waits for the first byte of a frame.
  FrameDecoder() = default;

  /// @brief Processes bytes from the line until a frame ends.
  /// @param bytes the bytes in their order; receives the bytes that are not yet processed
  /// @return the frame that ended, if any
  /// @isr{no}
  /// @satisfies FR-40
  /// @satisfies FR-41
  /// @satisfies FR-42
  /// @satisfies FR-43
  Decoded push(std::span<const std::uint8_t>& bytes);

  /// @brief Returns the frame that was received.
  /// @return the frame, valid until the next push
  /// @pre The last push returned Whole or UnknownVersion.
  /// @isr{no}
  [[nodiscard]] Frame frame() const;

 private:
  /// @brief Collects the bytes up to a zero byte.
  /// @param bytes bytes from the line
  /// @return number of bytes before the zero byte; of all bytes if there is no zero byte
  /// @satisfies FR-42
  std::size_t collect(std::span<const std::uint8_t> bytes);

  /// @brief Checks the collected bytes at the end of a frame.
  /// @return the result of the zero byte
  /// @satisfies FR-41
  /// @satisfies FR-42
  /// @satisfies FR-43
  Decoded end();

  /// @brief Replaces each code by the zero that it encodes: the body is then in place.
  /// @return false when the COBS is bad
  /// @satisfies FR-41
  bool removeStuffing();

  /// @brief Returns whether the CRC at the end of the body matches the bytes before it.
  /// @return true when it matches
  /// @satisfies FR-41
  [[nodiscard]] bool crcIsRight() const;

  std::array<std::uint8_t, kMaxBody + 1> bytes_{};  // coded bytes; after the end of the frame, the
                                                    // first code and the body
  std::size_t count_ = 0;                           // coded bytes since the last zero
  std::size_t length_ = 0;                          // of the last complete body
};

}  // namespace wr
