#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "devices/SerialPort.hpp"

namespace wr {

/// @brief A ring buffer from one writer to one reader. Writer and reader run on one core, and each
/// may preempt the other.
/// @tparam Element type of an element
/// @tparam kSize greatest number of elements, a power of 2
template <class Element, std::size_t kSize>
class Ring {
 public:
  /// @brief Returns the number of stored elements.
  /// @isr{yes}
  [[nodiscard]] std::size_t count() const { return written_ - read_; }

  /// @brief Returns the number of elements that can be stored.
  /// @isr{yes}
  [[nodiscard]] std::size_t free() const { return kSize - count(); }

  /// @brief Stores an element.
  /// @param element the element
  /// @pre There is space.
  /// @isr{yes}
  void put(const Element& element) {
    elements_[written_ % kSize] = element;
    written_ = written_ + 1;
  }

  /// @brief Returns the oldest element, and removes it.
  /// @pre An element is stored.
  /// @isr{yes}
  Element take() {
    const Element element = elements_[read_ % kSize];
    read_ = read_ + 1;
    return element;
  }

 private:
  static_assert(
      (kSize & (kSize - 1)) == 0,
      "the size is a power of 2, so that the positions stay correct when a count overflows");

  std::array<Element, kSize> elements_{};
  volatile std::size_t written_ = 0;
  volatile std::size_t read_ = 0;
};

/// @brief The buffers of a port, in both directions. A subclass transfers the bytes between the buffers and
/// its line.
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

  /// @brief Stores a received byte, or counts it as lost. The interrupt of the port calls this function.
  /// @param byte the byte
  /// @param at time at which it was received
  /// @isr{yes}
  void store(std::uint8_t byte, Instant at) {
    if (received_.free() == 0) {
      lose();
    } else {
      received_.put({.byte = byte, .at = at});
    }
  }

  /// @brief Counts a lost byte. The interrupt of the port calls this function.
  /// @isr{yes}
  void lose() {
    if (lost_ != std::numeric_limits<std::uint16_t>::max()) {
      lost_ = static_cast<std::uint16_t>(lost_ + 1);
    }
  }

  /// @brief Returns the buffer of the bytes to send. The interrupt of the port calls this function.
  /// @isr{yes}
  [[nodiscard]] auto& toSend() { return toSend_; }

 private:
  /// @brief A received byte, and the time at which it was received.
  struct Received {
    std::uint8_t byte = 0;
    Instant at;
  };

  /// @brief Starts to send, if the port is idle. It is called when there may be more bytes to send.
  virtual void beginSending() = 0;

  Ring<Received, 2048> received_;
  Ring<std::uint8_t, 512> toSend_;
  volatile std::uint16_t lost_ = 0;
  Instant receivedAt_;
};

}  // namespace wr
