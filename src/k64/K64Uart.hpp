#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "devices/SerialPort.hpp"

namespace wr {

/// @brief A serial port of the K64. Port 0 is the USB debug port of the board.
/// @function Receives and sends bytes in the background: 115200 baud, 8 bits, no parity, 1 stop bit.
/// @secret How bytes go between the registers of the port and the storage, and what the errors of the
/// line demand.
/// @hides{K64Uart::kBaud}
class K64Uart final : public SerialPort {
 public:
  /// @brief Speed of the line [baud].
  static constexpr std::uint32_t kBaud = 115'200;

  /// @brief A port of the part that is in use.
  enum class Port : std::uint8_t { Uart0 = 0, Uart4 = 1 };

  /// @brief Makes a port that is switched off.
  /// @param port which one it is; nothing else uses it
  explicit K64Uart(Port port);

  /// @brief Switches the port on.
  /// @pre The core runs at its full clock, and the clock of the port runs.
  /// @isr{no}
  /// @satisfies FR-171
  void start();

  /// @brief Takes what was received, and gives what is to be sent. The vectors of the port's interrupts
  /// call it.
  /// @isr{yes}
  /// @satisfies FR-171
  void serve();

  std::size_t read(std::span<std::uint8_t> bytes) override;
  [[nodiscard]] std::size_t free() const override;
  bool write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] std::uint16_t lostBytes() const override;

 private:
  // Bytes from one writer to one reader; each may interrupt the other.
  template <std::size_t kSize>
  class Ring {
   public:
    // Always inlined, as are load and store: these few instructions run for each byte.
    [[nodiscard, gnu::always_inline]] std::size_t count() const {
      return load(written_) - load(read_);
    }
    [[nodiscard]] std::size_t free() const { return kSize - count(); }
    void put(std::span<const std::uint8_t> bytes) {  // only with room
      const std::size_t at = load(written_);
      const auto place = std::span(bytes_).subspan(at % kSize);
      const auto ahead = bytes.first(std::min(bytes.size(), place.size()));
      const auto rest = bytes.subspan(ahead.size());
      std::memcpy(place.data(), ahead.data(), ahead.size());
      std::memcpy(bytes_.data(), rest.data(), rest.size());
      store(written_, at + bytes.size());
    }
    void take(std::span<std::uint8_t> bytes) {  // only with as many
      const std::size_t at = load(read_);
      const auto place = std::span(bytes_).subspan(at % kSize);
      const auto ahead = place.first(std::min(bytes.size(), place.size()));
      const auto rest = std::span(bytes_).first(bytes.size() - ahead.size());
      std::memcpy(bytes.data(), ahead.data(), ahead.size());
      std::memcpy(bytes.subspan(ahead.size()).data(), rest.data(), rest.size());
      store(read_, at + bytes.size());
    }
    void put(std::uint8_t byte) {  // only with room
      const std::size_t at = load(written_);
      bytes_[at % kSize] = byte;
      store(written_, at + 1);
    }
    std::uint8_t take() {  // only with bytes
      const std::size_t at = load(read_);
      const std::uint8_t byte = bytes_[at % kSize];
      store(read_, at + 1);
      return byte;
    }

   private:
    // Writer and reader run on one core: only the compiler could change the order of what they do.
    [[gnu::always_inline]] static std::size_t load(const std::atomic<std::size_t>& count) {
      const std::size_t value = count.load(std::memory_order_relaxed);
      std::atomic_signal_fence(std::memory_order_acquire);
      return value;
    }
    [[gnu::always_inline]] static void store(std::atomic<std::size_t>& count, std::size_t value) {
      std::atomic_signal_fence(std::memory_order_release);
      count.store(value, std::memory_order_relaxed);
    }

    static_assert((kSize & (kSize - 1)) == 0, "the counts wrap together with the places");

    std::array<std::uint8_t, kSize> bytes_{};
    std::atomic<std::size_t> written_{0};
    std::atomic<std::size_t> read_{0};
  };

  void receive();
  void send();

  [[nodiscard]] std::uint32_t offset() const;

  Port port_;
  // 115200 baud bring 1152 bytes in one cycle.
  Ring<2048> received_;
  Ring<512> toSend_;
  std::atomic<std::uint32_t> lost_{0};
};

}  // namespace wr
