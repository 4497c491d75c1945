#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "devices/SerialPort.hpp"
#include "devices/Timebase.hpp"

namespace wr {

/// @brief Serial port of the K64. Port 0 is connected to the USB debug port of the board.
/// @function Receives and sends bytes in the background, with 115200 baud, 8 data bits, no parity
/// and 1 stop bit.
/// @secret The transfer of bytes between the registers of the port and the buffers. The storage of
/// the times at which zero bytes were received. The handling of transmission errors.
/// @hides{K64Uart::kBaud}
class K64Uart final : public SerialPort {
 public:
  /// @brief Speed of the serial line [baud].
  static constexpr std::uint32_t kBaud = 115'200;

  /// @brief Size of the buffer of received bytes [bytes]. The port receives fewer bytes in one
  /// control cycle. The buffer also stores the bytes that arrive while a cycle is late.
  static constexpr std::size_t kReceiveBytes = 2048;

  /// @brief Size of the transmit buffer [bytes].
  static constexpr std::size_t kSendBytes = 512;

  /// @brief A serial port that the firmware uses.
  enum class Port : std::uint8_t { Uart0 = 0, Uart4 = 1 };

  /// @brief Selection of the received zero bytes that a port stores. All: every zero byte is
  /// stored. Ends: a zero byte is stored only if the byte before it is not zero, because only such
  /// a zero byte ends a frame.
  enum class ZeroBytes : std::uint8_t { All, Ends };

  /// @brief Constructs a port that is not switched on yet.
  /// @param port the port; no other object may use it
  /// @param clock timebase, which returns the time at which a zero byte is received
  /// @param zeros selection of the zero bytes that the port stores
  K64Uart(Port port, const Timebase& clock, ZeroBytes zeros = ZeroBytes::Ends);

  /// @brief Switches the port on. Port 0 uses its FIFOs; the other port has no FIFOs.
  /// @pre The core runs at its full clock, and the clock gate of the port is open.
  /// @isr{no}
  /// @satisfies FR-171
  void start();

  /// @brief Stores the bytes that the hardware has received, and passes the next bytes to the
  /// transmitter. The handler of the port's interrupts calls this function.
  /// @isr{yes}
  /// @satisfies FR-171
  void serve();

  std::size_t read(std::span<std::uint8_t> bytes) override;
  [[nodiscard]] Instant receivedAt() const override { return receivedAt_; }
  [[nodiscard]] std::size_t free() const override;
  bool write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] std::uint16_t lostBytes() const override;

 private:
  // Ring buffer for one writer and one reader. The writer may preempt the reader, and the reader
  // may preempt the writer.
  template <class Element, std::size_t kSize>
  class Ring {
   public:
    // count(), load() and store() are always inlined: they have few instructions and run for each
    // element.
    [[nodiscard, gnu::always_inline]] std::size_t count() const { return end() - first(); }
    [[nodiscard]] std::size_t free() const { return kSize - count(); }
    void put(std::span<const Element> elements) {  // precondition: the buffer has enough space
      const std::size_t at = load(written_);
      const auto place = std::span(elements_).subspan(at % kSize);
      const auto ahead = elements.first(std::min(elements.size(), place.size()));
      const auto rest = elements.subspan(ahead.size());
      // bound: kMaxCoded + 1
      std::memcpy(place.data(), ahead.data(), ahead.size_bytes());
      // bound: kMaxCoded + 1
      std::memcpy(elements_.data(), rest.data(), rest.size_bytes());
      store(written_, at + elements.size());
    }
    void put(Element element) {  // precondition: the buffer has enough space
      const std::size_t at = load(written_);
      elements_[at % kSize] = element;
      store(written_, at + 1);
    }
    Element take() {  // precondition: the buffer is not empty
      const std::size_t place = first();
      const Element element = at(place);
      dropUpTo(place + 1);
      return element;
    }
    // Returns the position of the next element to read. The position of an element is the number of
    // elements that were written since start and before this element.
    [[nodiscard]] std::size_t first() const { return load(read_); }
    // Returns the position after the last element.
    [[nodiscard]] std::size_t end() const { return load(written_); }
    [[nodiscard]] Element at(std::size_t place) const { return elements_[place % kSize]; }
    void dropUpTo(std::size_t place) { store(read_, place); }

   private:
    // Writer and reader run on the same core. Therefore only the compiler could change the sequence
    // of their accesses, and the signal fence prevents this change.
    [[gnu::always_inline]] static std::size_t load(const std::atomic<std::size_t>& count) {
      const std::size_t value = count.load(std::memory_order_relaxed);
      std::atomic_signal_fence(std::memory_order_acquire);
      return value;
    }
    [[gnu::always_inline]] static void store(std::atomic<std::size_t>& count, std::size_t value) {
      std::atomic_signal_fence(std::memory_order_release);
      count.store(value, std::memory_order_relaxed);
    }

    static_assert(
        (kSize & (kSize - 1)) == 0,
        "the size must be a power of 2; then the positions stay correct when a count overflows");

    std::array<Element, kSize> elements_{};
    std::atomic<std::size_t> written_{0};
    std::atomic<std::size_t> read_{0};
  };

  void receive();
  bool store(std::uint8_t byte);
  void send();

  [[nodiscard]] std::uint32_t offset() const;

  Port port_;
  ZeroBytes zeros_;
  const Timebase& clock_;
  Ring<std::uint8_t, kReceiveBytes> received_;
  // Times at which the stored zero bytes were received. With ZeroBytes::Ends, at most every second
  // stored byte is zero.
  Ring<Instant, kReceiveBytes / 2> endings_;
  Ring<std::uint8_t, kSendBytes> toSend_;
  std::atomic<std::uint32_t> lost_{0};
  std::uint8_t lastStored_ = 0;
  Instant receivedAt_;
};

}  // namespace wr
