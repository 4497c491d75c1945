#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "devices/SerialPort.hpp"

namespace wr {

/// @brief A ring buffer for one writer and one reader. The writer and the reader run on the same
/// core, and each may preempt the other.
/// @tparam Element type of an element
/// @tparam kSize greatest number of elements, a power of 2
template <class Element, std::size_t kSize>
class Ring {
 public:
  /// @brief Returns the number of stored elements.
  /// @isr{yes}
  [[nodiscard]] std::size_t count() const { return written_ - read_; }

  /// @brief Returns the number of free places for elements.
  /// @isr{yes}
  [[nodiscard]] std::size_t free() const { return kSize - count(); }

  /// @brief Stores an element.
  /// @param element element that is stored
  /// @pre free() does not return 0.
  /// @isr{yes}
  void put(const Element& element) {
    elements_[written_ % kSize] = element;
    written_ = written_ + 1;
  }

  /// @brief Returns the oldest element, and removes it.
  /// @pre count() does not return 0.
  /// @isr{yes}
  Element take() {
    const Element element = elements_[read_ % kSize];
    read_ = read_ + 1;
    return element;
  }

 private:
  static_assert(
      (kSize & (kSize - 1)) == 0,
      "the size must be a power of 2, because otherwise the positions are wrong after an overflow");

  std::array<Element, kSize> elements_{};
  volatile std::size_t written_ = 0;
  volatile std::size_t read_ = 0;
};

/// @brief A serial port with a buffer for received bytes and a buffer for bytes to send. A subclass
/// transfers the bytes between these buffers and the hardware.
class BufferedPort : public SerialPort {
 public:
  std::size_t read(std::span<std::uint8_t> bytes) override {
    const std::size_t most = std::min(bytes.size(), received_.count());
    std::size_t count = 0;
    while (count != most) {
      const Received next = received_.take();
      bytes[count] = next.byte;
      ++count;
      if (next.byte == 0) {
        receivedAt_ = next.at;
        break;
      }
    }
    return count;
  }

  [[nodiscard]] Instant receivedAt() const override { return receivedAt_; }
  [[nodiscard]] std::size_t free() const override { return toSend_.free(); }

  bool write(std::span<const std::uint8_t> bytes) override {
    if (bytes.size() > toSend_.free()) {
      return false;
    }
    for (const std::uint8_t byte : bytes) {
      toSend_.put(byte);
    }
    beginSending();
    return true;
  }

  [[nodiscard]] std::uint16_t lostBytes() const override { return lost_; }

 protected:
  BufferedPort() = default;
  ~BufferedPort() = default;

  /// @brief Stores a received byte, or counts the byte as lost if the buffer is full. The interrupt
  /// handler of the port calls this function.
  /// @param byte received byte
  /// @param at time at which the byte was received
  /// @isr{yes}
  void store(std::uint8_t byte, Instant at) {
    if (received_.free() == 0) {
      lose();
    } else {
      received_.put({.byte = byte, .at = at});
    }
  }

  /// @brief Counts a lost byte. The interrupt handler of the port calls this function.
  /// @isr{yes}
  void lose() {
    if (lost_ != std::numeric_limits<std::uint16_t>::max()) {
      lost_ = static_cast<std::uint16_t>(lost_ + 1);
    }
  }

  /// @brief Returns the buffer of the bytes to send. The interrupt handler of the port calls this
  /// function.
  /// @isr{yes}
  [[nodiscard]] auto& toSend() { return toSend_; }

 private:
  /// @brief A received byte, and the time at which this byte was received.
  struct Received {
    std::uint8_t byte = 0;
    Instant at;
  };

  /// @brief Starts to send if the port is not sending yet. write() calls this function after it has
  /// stored bytes.
  virtual void beginSending() = 0;

  Ring<Received, 2048> received_;
  Ring<std::uint8_t, 512> toSend_;
  volatile std::uint16_t lost_ = 0;
  Instant receivedAt_;
};

}  // namespace wr
