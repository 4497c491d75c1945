#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "sim/scenario/FrameTable.hpp"
#include "sim/scenario/Payload.hpp"

namespace wr::scenario {

/// The set-points and commands of an order.
struct PcOrder {
  struct Wheel {
    std::uint8_t quantity = 0;
    std::int16_t value = 0;
  };
  std::uint16_t id = 0;
  std::int16_t steering = 0;
  std::array<Wheel, 4> wheels{};
  bool stop = false;
  bool acknowledge = false;
  std::uint32_t sentAt = 0;
};

using PcReport = ReportPayload;
using PcWelcome = WelcomePayload;

/// The PC's side of the protocol. Builds the bytes of successive frames, with their sequence
/// numbers. Does not use the firmware's codec.
class PcSender {
 public:
  [[nodiscard]] Bytes hello();
  [[nodiscard]] Bytes confirm(std::uint8_t session);
  [[nodiscard]] Bytes keepAlive();
  [[nodiscard]] Bytes order(const PcOrder& order);
  [[nodiscard]] Bytes frame(std::uint8_t type, std::span<const std::uint8_t> payload,
                            std::uint8_t version = 2);

 private:
  std::uint8_t sequence_ = 0;
};

/// The body of a frame without its CRC, or a description of the damage of the frame.
struct FrameBody {
  Bytes bytes;
  std::string_view damage;  ///< empty if the frame has no error
};

/// Decodes the bytes between two zero bytes. Returns the body of the frame, or a description of its
/// damage.
[[nodiscard]] FrameBody bodyOf(std::span<const std::uint8_t> frame);

/// Returns the bodies of all frames in received bytes, without their CRC. Throws an exception if a
/// frame has an error.
[[nodiscard]] std::vector<Bytes> bodies(std::span<const std::uint8_t> line);

/// Returns the content of a Welcome; nothing if the body is not a Welcome.
[[nodiscard]] std::optional<PcWelcome> welcomeOf(const Bytes& body);

/// Returns the content of a report; nothing if the body is not a Report.
[[nodiscard]] std::optional<PcReport> reportOf(const Bytes& body);

}  // namespace wr::scenario
