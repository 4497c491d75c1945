#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace wr {

/// @brief Kind of the payload of a frame.
/// @datatype
enum class FrameType : std::uint8_t {
  Hello = 0x01,      ///< the PC requests a connection
  Confirm = 0x02,    ///< the PC accepts the session that a Welcome offered
  KeepAlive = 0x03,  ///< the PC shows that it is still connected
  Order = 0x04,      ///< the PC sends an order
  Welcome = 0x81,    ///< the firmware answers a Hello
  Report = 0x82      ///< the firmware reports one control cycle
};

/// @brief The content of a frame: type, sequence number and payload.
/// @datatype
struct Frame {
  FrameType type = FrameType::Hello;        ///< kind of the payload; a received frame may contain a
                                            ///< number that is not in FrameType
  std::uint8_t sequence = 0;                ///< sequence number, assigned by the sender
  std::span<const std::uint8_t> payload{};  ///< the payload
};

/// @brief Version of the PC protocol that this firmware uses. Every frame contains the version of
/// its sender.
inline constexpr std::uint8_t kProtocolVersion = 2;

/// @brief Lowest protocol version that the firmware accepts. Frames of other versions are dropped,
/// except a Hello: the firmware answers a Hello of any version.
inline constexpr std::uint8_t kLowestVersion = kProtocolVersion;

/// @brief Highest protocol version that the firmware accepts.
inline constexpr std::uint8_t kHighestVersion = kProtocolVersion;

/// @brief Least number of bytes of a frame body: version, type, sequence number and check sum,
/// without a payload.
inline constexpr std::size_t kMinBody = 5;

/// @brief Greatest number of bytes of a frame body.
inline constexpr std::size_t kMaxBody = 205;

/// @brief Greatest number of bytes of the payload of a frame.
inline constexpr std::size_t kMaxPayload = kMaxBody - kMinBody;

/// @brief Greatest number of bytes of a frame on the serial line: the body, one byte of the byte
/// stuffing, and the zero byte that ends the frame.
inline constexpr std::size_t kMaxCoded = kMaxBody + 2;

}  // namespace wr
