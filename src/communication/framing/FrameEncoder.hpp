#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "communication/framing/Frame.hpp"

namespace wr {

/// @brief Encoder of the frames that are sent.
/// @function Converts the type, the sequence number and the payload of a frame to the bytes that
/// are sent.
/// @secret The steps that build the coded bytes of a frame in a single buffer.
class FrameEncoder final {
 public:
  /// @brief Greatest number of bytes that encode() returns.
  static constexpr std::size_t kMaxBytes = kMaxCoded;

  /// @brief Constructs an encoder with an empty buffer.
  FrameEncoder() = default;

  /// @brief Returns the coded bytes of one frame.
  /// @param frame type, sequence number and payload of at most kMaxPayload bytes
  /// @return the bytes to send, including the zero byte that ends the frame; valid until the next
  /// call
  /// @errors If the payload has more than kMaxPayload bytes, the program ends with the assertion
  /// FrameTooLarge.
  /// @isr{no}
  /// @satisfies FR-40
  /// @satisfies FR-176
  [[nodiscard]] std::span<const std::uint8_t> encode(const Frame& frame);

 private:
  std::array<std::uint8_t, kMaxCoded> coded_{};
};

}  // namespace wr
