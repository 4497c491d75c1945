#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "communication/framing/Frame.hpp"

namespace wr {

/// @brief Builds frames for the line.
/// @function Converts type, sequence number and payload to the bytes to send.
/// @secret How the bytes to send are built in one buffer.
class FrameEncoder final {
 public:
  /// @brief Greatest number of bytes that encode() returns.
  static constexpr std::size_t kMaxBytes = kMaxCoded;

  /// @brief Constructs an encoder without a frame.
  FrameEncoder() = default;

  /// @brief Builds one frame.
  /// @param frame type, sequence number and payload of at most 200 bytes
  /// @return the bytes for the line, with the zero that ends them; valid until the next call
  /// @errors Assertion FrameTooLarge when the payload has more than 200 bytes.
  /// @isr{no}
  /// @satisfies FR-40
  /// @satisfies FR-176
  [[nodiscard]] std::span<const std::uint8_t> encode(const Frame& frame);

 private:
  std::array<std::uint8_t, kMaxCoded> coded_{};
};

}  // namespace wr
