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

  /// @brief Returns the storage for the next bytes from the line.
  /// @return storage for at least one byte, valid until the next push
  /// @isr{no}
  [[nodiscard]] std::span<std::uint8_t> storage();

  /// @brief Processes bytes at the beginning of the storage. Only the last of them may be zero.
  /// @param number number of these bytes, at least 1
  /// @return the frame that ended, if any
  /// @pre The bytes fit into the storage.
  /// @isr{no}
  /// @satisfies FR-40
  /// @satisfies FR-41
  /// @satisfies FR-42
  /// @satisfies FR-43
  Decoded push(std::size_t number);

  /// @brief Returns the frame that was received.
  /// @return the frame, valid until the next push
  /// @pre The last push returned Whole or UnknownVersion.
  /// @isr{no}
  [[nodiscard]] Frame frame() const;

 private:
  /// @brief Checks the collected bytes at the end of a frame.
  /// @param coded number of bytes before the zero byte, at least 1
  /// @return the result of the zero byte
  /// @satisfies FR-41
  /// @satisfies FR-43
  Decoded end(std::size_t coded);

  /// @brief Replaces each code by the zero that it encodes: the body is then in place.
  /// @param end number of coded bytes
  /// @return false when the COBS is bad
  /// @satisfies FR-41
  bool removeStuffing(std::size_t end);

  /// @brief Returns whether the CRC at the end of the body matches the bytes before it.
  /// @return true when it matches
  /// @satisfies FR-41
  [[nodiscard]] bool crcIsRight() const;

  std::array<std::uint8_t, kMaxCoded> bytes_{};  // coded bytes; after the end of the frame, the
                                                 // first code and the body
  std::size_t count_ = 0;                        // bytes of the frame that has not ended
  std::size_t length_ = 0;                       // length of the last complete body
  bool tooLong_ = false;                         // bytes of this frame were dropped
};

}  // namespace wr
