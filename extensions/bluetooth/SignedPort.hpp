#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "bluetooth/RandomSource.hpp"
#include "bluetooth/SipHash.hpp"
#include "communication/framing/FrameEncoder.hpp"
#include "devices/SerialPort.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief A serial port whose frames are authenticated.
///
/// @function Extends a serial port. Each frame on the line has a counter and a tag between its coded
/// bytes and the zero that ends it. Received frames with a wrong tag, or with a counter that is not
/// greater than the previous counter, are dropped. Other received frames are returned without
/// counter and tag. Each frame to send gets a counter and a tag. A wrong frame is answered with a
/// challenge, which contains the values that an authorised sender needs for its tags.
///
/// @secret How counter and tag are put on the line, and the content of the tag. The tag is computed
/// over a random number of the start, the direction, the counter and the coded frame.
class SignedPort final : public SerialPort {
 public:
  /// @brief Type of the frame that challenges the sender: a random number (u64) and the last counter (u32).
  static constexpr FrameType kChallenge{0x83};
  /// @brief Characters between a coded frame and its zero: 8 hexadecimal digits of the counter, then 16 of
  /// the tag.
  static constexpr std::size_t kTrailer = 24;

  /// @brief Binds the port to its line and its key. Without a random number it receives and sends nothing.
  /// @param port line to the Bluetooth module
  /// @param key secret key; if all its bytes are 0xFF, there is no key, and nothing is received or
  /// sent
  /// @param random generator of the random number that identifies this start
  /// @satisfies FR-264
  SignedPort(SerialPort& port, const SipHash::Key& key, RandomSource& random);

  /// @brief Returns the bytes of at most one frame whose tag is correct and whose counter is new.
  /// @param bytes receives the bytes
  /// @return number of these bytes; 0 when there is no such frame
  /// @isr{no}
  /// @satisfies FR-262
  std::size_t read(std::span<std::uint8_t> bytes) override;

  /// @brief Returns the time at which the last byte of the frame from read() was received.
  /// @return time of its zero byte
  /// @isr{no}
  [[nodiscard]] Instant receivedAt() const override;

  /// @brief Returns the free space for bytes to send, minus the space for counter and tag.
  /// @return number of bytes of a coded frame that a write can accept now
  /// @isr{no}
  [[nodiscard]] std::size_t free() const override;

  /// @brief Sends one coded frame with counter and tag, or nothing.
  /// @param bytes bytes of a coded frame with the zero that ends it
  /// @return false when there is no space, no key or no random number: nothing is sent
  /// @isr{no}
  /// @satisfies FR-263
  bool write(std::span<const std::uint8_t> bytes) override;

  /// @brief Returns the number of lost bytes of the line.
  /// @return number of lost bytes since start, at most 65535
  /// @isr{no}
  [[nodiscard]] std::uint16_t lostBytes() const override;

 private:
  using Coded = std::array<std::uint8_t, FrameEncoder::kMaxBytes + kTrailer>;

  /// @brief Checks whether there is a key and a random number.
  /// @return true when both exist
  /// @satisfies FR-265
  [[nodiscard]] bool works() const;
  void collect(std::uint8_t byte);
  [[nodiscard]] bool accept();
  void challenge();
  [[nodiscard]] std::uint64_t tagOf(std::uint8_t direction, std::uint32_t counter,
                                    std::span<const std::uint8_t> coded) const;

  SerialPort& port_;
  SipHash::Key key_;
  std::optional<std::uint64_t> nonce_;
  FrameEncoder encoder_;
  Coded received_{};
  std::size_t count_ = 0;           // received bytes of the present frame; more than the capacity:
                                    // the frame is too long
  std::size_t ready_ = 0;           // bytes of the accepted frame that were not read yet
  std::size_t given_ = 0;           // number of these bytes that were read
  std::uint32_t lastReceived_ = 0;  // counter of the last accepted frame
  std::uint32_t lastSent_ = 0;      // counter of the last sent frame
};

}  // namespace wr
