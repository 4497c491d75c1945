#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "devices/SerialPort.hpp"
#include "devices/Timebase.hpp"

namespace wr::mps2 {

/// @brief The first serial port of the board, at 115200 baud. It has no FIFO.
class CmsdkUart final : public SerialPort {
 public:
  /// @brief Makes the port.
  /// @param clock time of the received zero bytes
  explicit CmsdkUart(const Timebase& clock);

  /// @brief Starts the port.
  /// @isr{no}
  void start();

  /// @brief Serves the interrupts of the port.
  /// @isr{yes}
  void serve();

  std::size_t read(std::span<std::uint8_t> bytes) override;
  [[nodiscard]] Instant receivedAt() const override { return receivedAt_; }
  [[nodiscard]] std::size_t free() const override { return kToSend - toSend_.count(); }
  bool write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] std::uint16_t lostBytes() const override { return lost_; }

 private:
  static constexpr std::size_t kReceived = 2048;
  static constexpr std::size_t kToSend = 512;

  /// @brief A received byte, and when it was received.
  struct Received {
    std::uint8_t byte = 0;
    Instant at;
  };

  /// @brief A ring buffer from one writer to one reader; each may preempt the other on this one core.
  template <class Element, std::size_t kSize>
  struct Ring {
    static_assert((kSize & (kSize - 1)) == 0, "the counts wrap together with the places");

    [[nodiscard]] std::size_t count() const { return written - read; }
    void put(const Element& element) {
      elements[written % kSize] = element;
      written = written + 1;
    }
    Element take() {
      const Element element = elements[read % kSize];
      read = read + 1;
      return element;
    }

    std::array<Element, kSize> elements{};
    volatile std::size_t written = 0;
    volatile std::size_t read = 0;
  };

  const Timebase& clock_;
  Ring<Received, kReceived> received_;
  Ring<std::uint8_t, kToSend> toSend_;
  volatile std::uint16_t lost_ = 0;
  Instant receivedAt_;
};

}  // namespace wr::mps2
