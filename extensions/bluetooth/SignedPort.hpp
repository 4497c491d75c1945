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

/// @brief A serial port that authenticates frames.
///
/// @function Extends a serial port. Adds a counter and a tag to each sent frame, between the coded
/// bytes and the final zero byte. Drops a received frame if its tag is wrong, or if its counter is
/// not greater than the counter of the last accepted frame. Otherwise removes the counter and the
/// tag, and returns the frame. Answers a dropped frame with a challenge, if the port has enough
/// space. A challenge is a frame without counter and tag. The challenge contains the values with
/// which an authorised sender computes its tags.
///
/// @secret The coding of the counter and the tag of a frame, and the data from which the tag is
/// computed: the random number of this start, the direction, the counter and the coded frame.
class SignedPort final : public SerialPort {
 public:
  /// @brief Frame type of a challenge. Its payload is the random number of this start (u64) and the
  /// last accepted counter (u32).
  static constexpr FrameType kChallenge{0x83};
  /// @brief Number of characters between the coded bytes of a frame and its final zero byte: 8
  /// hexadecimal digits of the counter, then 16 hexadecimal digits of the tag.
  static constexpr std::size_t kTrailer = 24;

  /// @brief Gets the random number of this start from the generator. If the generator returns no
  /// number, this port receives and sends nothing.
  /// @param port extended port, to which the Bluetooth module is connected
  /// @param key secret key. If all its bytes are 0xFF, the robot has no key, and this port receives
  /// and sends nothing
  /// @param random generator of the random number that identifies this start
  /// @satisfies FR-264
  SignedPort(SerialPort& port, const SipHash::Key& key, RandomSource& random);

  /// @brief Reads bytes of at most one accepted frame. A frame is accepted if its tag is correct,
  /// and if its counter is greater than the last accepted counter.
  /// @param bytes receives the bytes of the coded frame, without counter and tag
  /// @return number of bytes that were read; 0 if there is no accepted frame
  /// @isr{no}
  /// @satisfies FR-262
  std::size_t read(std::span<std::uint8_t> bytes) override;

  /// @brief Returns the reception time of the last frame that read() returned.
  /// @return time at which the final zero byte of this frame was received
  /// @isr{no}
  [[nodiscard]] Instant receivedAt() const override;

  /// @brief Returns the free space in the transmit buffer, minus the space for counter and tag.
  /// @return number of bytes of a coded frame that write() can accept now
  /// @isr{no}
  [[nodiscard]] std::size_t free() const override;

  /// @brief Sends one coded frame with a counter and a tag. A single zero byte is sent without
  /// counter and tag: it only ends a frame that a reset interrupted.
  /// @param bytes bytes of a coded frame, including its final zero byte
  /// @return true if the whole frame is sent; false if nothing is sent, for one of these reasons:
  /// there is not enough space, there is no key, there is no random number, the frame is too long,
  /// or `bytes` is empty
  /// @isr{no}
  /// @satisfies FR-263
  bool write(std::span<const std::uint8_t> bytes) override;

  /// @brief Returns the number of received bytes that the extended port has lost.
  /// @return number of lost bytes since the start, at most 65535
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
  // Number of received bytes of the present frame. If the frame is too long, the count stops at the
  // size of `received_` plus 1.
  std::size_t count_ = 0;
  std::size_t ready_ = 0;           // number of bytes of the accepted frame
  std::size_t given_ = 0;           // number of bytes of this frame that read() has returned
  std::uint32_t lastReceived_ = 0;  // counter of the last accepted frame
  std::uint32_t lastSent_ = 0;      // counter of the last sent frame
  bool challenged_ = false;         // a challenge was sent since the start
};

}  // namespace wr
