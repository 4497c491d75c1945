#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace wr {

/// @brief Kind of the payload of a frame.
/// @datatype
enum class FrameType : std::uint8_t {
  Hello = 0x01,      ///< the PC requests a connection
  Confirm = 0x02,    ///< the PC accepts a session
  KeepAlive = 0x03,  ///< the PC keeps the connection
  Order = 0x04,      ///< the PC orders
  Welcome = 0x81,    ///< the system answers a Hello
  Report = 0x82      ///< the system reports one cycle
};

/// @brief A frame without its coding for the line.
/// @datatype
struct Frame {
  FrameType type = FrameType::Hello;  ///< kind of the payload; values without a name are possible
  std::uint8_t sequence = 0;          ///< number of the frame from its sender
  std::span<const std::uint8_t> payload{};  ///< the payload
};

/// @brief Version of the protocol, which every frame contains.
inline constexpr std::uint8_t kProtocolVersion = 2;

/// @brief Lowest version of the protocol that is accepted. Only a Hello of another version is answered.
inline constexpr std::uint8_t kLowestVersion = kProtocolVersion;

/// @brief Highest version of the protocol that is accepted.
inline constexpr std::uint8_t kHighestVersion = kProtocolVersion;

/// @brief Least number of bytes of a body.
inline constexpr std::size_t kMinBody = 5;

/// @brief Greatest number of bytes of a body.
inline constexpr std::size_t kMaxBody = 205;

/// @brief Greatest number of bytes of a payload.
inline constexpr std::size_t kMaxPayload = kMaxBody - kMinBody;

/// @brief Greatest number of bytes of a frame on the line, with the zero that ends it.
inline constexpr std::size_t kMaxCoded = kMaxBody + 2;

}  // namespace wr
