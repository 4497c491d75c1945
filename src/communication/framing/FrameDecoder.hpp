#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "communication/framing/Frame.hpp"

namespace wr {

/// @brief Result of the decoding of received bytes.
/// @datatype
enum class Decoded : std::uint8_t {
  Nothing,        ///< no frame ended; a zero byte is ignored if no frame precedes it
  Whole,          ///< the bytes end a frame that has no error
  Damaged,        ///< a frame with bad COBS, a bad CRC or a body of fewer than 5 bytes
  TooLong,        ///< a frame with a body of more than 205 bytes
  UnknownVersion  ///< a frame of another protocol version
};

/// @brief Decoder of the received frames.
/// @function Collects received bytes until a frame ends, and checks the frame for errors. After
/// damaged bytes, the decoder continues with the next frame.
/// @secret The storage of an incomplete frame, the checks of a complete frame, and the method to
/// find the next frame after damaged bytes.
class FrameDecoder final {
 public:
  /// @brief Constructs a decoder that waits for the first byte of a frame.
  FrameDecoder() = default;

  /// @brief Returns the storage into which the caller writes the next received bytes.
  /// @return storage for at least one byte, valid until the next push
  /// @isr{no}
  [[nodiscard]] std::span<std::uint8_t> storage();

  /// @brief Decodes the bytes that the caller has written to the beginning of the storage. Only
  /// the last of these bytes may be zero.
  /// @param number number of these bytes, at least 1
  /// @return Nothing if these bytes end no frame; otherwise the result of the checks of this frame
  /// @pre The bytes fit into the storage.
  /// @isr{no}
  /// @satisfies FR-40
  /// @satisfies FR-41
  /// @satisfies FR-42
  /// @satisfies FR-43
  Decoded push(std::size_t number);

  /// @brief Returns the frame that the last push completed.
  /// @return the frame, valid until the next push
  /// @pre The last push returned Whole or UnknownVersion.
  /// @isr{no}
  [[nodiscard]] Frame frame() const;

 private:
  /// @brief Checks the collected bytes of a frame. The caller calls this function after the zero
  /// byte that ends the frame.
  /// @param coded number of bytes before the zero byte, at least 1
  /// @return Whole, UnknownVersion or Damaged
  /// @satisfies FR-41
  /// @satisfies FR-43
  Decoded end(std::size_t coded);

  /// @brief Replaces each COBS code by the zero byte that it encodes. The first code is not
  /// replaced: it is before the body.
  /// @param end number of coded bytes
  /// @return false when a code points beyond the zero byte that ends the frame
  /// @satisfies FR-41
  bool removeStuffing(std::size_t end);

  /// @brief Returns whether the CRC at the end of the body matches the bytes before it.
  /// @return true when the CRC matches
  /// @satisfies FR-41
  [[nodiscard]] bool crcIsRight() const;

  std::array<std::uint8_t, kMaxCoded> bytes_{};  // coded bytes of an incomplete frame; when the
                                                 // frame is complete: first code, decoded body
  std::size_t count_ = 0;                        // number of bytes of the incomplete frame
  std::size_t length_ = 0;                       // length of the last complete body [bytes]
  bool tooLong_ = false;                         // the incomplete frame is too long, and its first
                                                 // bytes were dropped
};

}  // namespace wr
