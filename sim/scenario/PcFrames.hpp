#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace wr {

using Bytes = std::vector<std::uint8_t>;

/// The PC's side of the protocol, written from the protocol page and without the firmware's codec.
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

/// Place of the unexpected frames in PcReport::dropped.
inline constexpr std::size_t kUnexpected = 6;

/// A report as the PC reads it.
struct PcReport {
  std::uint32_t cycle = 0;
  std::uint32_t time = 0;
  std::uint8_t state = 0;
  std::uint8_t mode = 0;
  std::uint8_t source = 0;
  std::uint8_t flags = 0;
  std::uint16_t orderId = 0;
  std::int16_t steering = 0;
  std::array<PcOrder::Wheel, 4> wheels{};
  std::int16_t steeringPosition = 0;
  std::array<std::int16_t, 4> velocity{};  // of each wheel, as all arrays of four
  std::array<std::int16_t, 4> current{};
  std::array<std::int32_t, 4> position{};
  std::uint16_t measured = 0;
  std::array<std::int16_t, 4> tension{};
  std::int8_t turn = 0;
  std::uint8_t applied = 0;
  std::uint16_t overruns = 0;
  std::uint16_t lostBytes = 0;
  std::array<std::uint16_t, 7> dropped{};  // damaged, too long, unknown version, unknown type,
                                           // wrong length, out of range, unexpected
  std::uint16_t reportsNotSent = 0;
  std::uint8_t steeringState = 0;
  std::uint8_t steeringEnds = 0;
  std::uint8_t cutOffs = 0;
  std::uint8_t blindWheels = 0;
  std::array<std::uint16_t, 4> rejectedEdges{};
  std::uint32_t reportCycles = 0;
  std::uint32_t awakeCycles = 0;
  std::uint32_t startCycles = 0;
  std::uint8_t inhibit = 0;
  std::uint8_t stopCause = 0;
  std::uint8_t stopWheel = 0;
  std::uint8_t stopSources = 0;
  std::uint32_t sentAt = 0;
  std::uint16_t staleOrders = 0;

  [[nodiscard]] bool stop() const { return (flags & 1U) != 0; }
  [[nodiscard]] bool orderRead() const { return (flags & 2U) != 0; }
  [[nodiscard]] bool held() const { return (flags & 4U) != 0; }
  [[nodiscard]] bool overran() const { return (flags & 8U) != 0; }
  [[nodiscard]] bool armed() const { return (flags & 16U) != 0; }
};

/// A Welcome as the PC reads it.
struct PcWelcome {
  std::uint8_t session = 0;
  std::uint16_t cyclePeriod = 0;
  std::uint8_t waitingCycles = 0;
  std::uint8_t resetCause = 0;
  std::uint8_t faultKind = 0;
  std::uint16_t faultNumber = 0;
  std::uint32_t faultAddress = 0;
  std::uint8_t lowestVersion = 0;
  std::uint8_t highestVersion = 0;
  std::uint32_t schemaHash = 0;
};

/// Makes the bytes of one frame after another, counting the sequence numbers.
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

/// The bodies of all frames in some bytes, without their CRC. A frame that is not in order throws.
[[nodiscard]] std::vector<Bytes> bodies(std::span<const std::uint8_t> line);

/// The content of a Welcome; nothing if the body is no Welcome.
[[nodiscard]] std::optional<PcWelcome> welcomeOf(const Bytes& body);

/// The content of a report; nothing if the body is no Report.
[[nodiscard]] std::optional<PcReport> reportOf(const Bytes& body);

}  // namespace wr
