#include "bluetooth/SignedPort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "sim/host/HostSerialPort.hpp"
#include "sim/scenario/PcFrames.hpp"
#include "support/FakeSerialPort.hpp"
#include "support/FakeTimebase.hpp"
#include "support/SignedLine.hpp"

namespace wr::test {
namespace {

constexpr std::uint8_t kChallengeType = 0x83;

SipHash::Key erased() {
  SipHash::Key key{};
  key.fill(0xFF);
  return key;
}

class SignedPortTest : public testing::Test {
 protected:
  // Returns the frames that can be read from the port now.
  std::vector<scenario::Bytes> given(SignedPort& from) {
    std::vector<scenario::Bytes> taken;
    std::array<std::uint8_t, 64> bytes{};
    scenario::Bytes frame;
    for (std::size_t count = from.read(bytes); count > 0; count = from.read(bytes)) {
      frame.insert(frame.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count));
      if (frame.back() == 0) {
        taken.push_back(std::exchange(frame, {}));
      }
    }
    return taken;
  }
  std::vector<scenario::Bytes> given() { return given(signedPort); }

  host::HostSerialPort line;
  FixedRandom random{kStartNumber};
  SignedPort signedPort{line, kSharedKey, random};
  SigningDevice device;
  scenario::PcSender frames;
};

/// @brief If a received frame has a correct tag and a new counter, the port returns this frame. The
/// port first removes the counter and the tag.
/// @verifies FR-262
TEST_F(SignedPortTest, FR262_RightFrameIsGiven) {
  const scenario::Bytes hello = frames.hello();
  line.arrive(device.sign(hello));
  EXPECT_EQ(given(), std::vector<scenario::Bytes>{hello});
  const scenario::Bytes order = frames.order({.id = 3});
  line.arrive(device.sign(order));
  EXPECT_EQ(given(), std::vector<scenario::Bytes>{order});
}

/// @brief A frame is dropped when a single bit is wrong. The bit can be in the frame, in its
/// counter or in its tag.
/// @verifies FR-262
TEST_F(SignedPortTest, FR262_EachWrongBitHasTheFrameDropped) {
  const scenario::Bytes right = device.sign(frames.order({.id = 3}));
  for (std::size_t bit = 0; bit < 8 * (right.size() - 1); ++bit) {
    scenario::Bytes wrong = right;
    wrong[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    line.arrive(wrong);
    EXPECT_TRUE(given().empty()) << "bit " << bit;
    static_cast<void>(line.takeSent());
  }
  line.arrive(right);
  EXPECT_EQ(given().size(), 1U);
}

/// @brief A repeated frame and a frame with an older counter are dropped.
/// @verifies FR-262
TEST_F(SignedPortTest, FR262_ReplayedFrameIsDropped) {
  const scenario::Bytes order = frames.order({.id = 3});
  line.arrive(device.signWith(5, order));
  EXPECT_EQ(given().size(), 1U);
  line.arrive(device.signWith(5, order));
  line.arrive(device.signWith(4, order));
  EXPECT_TRUE(given().empty());
  line.arrive(device.signWith(6, order));
  EXPECT_EQ(given().size(), 1U);
}

/// @brief Frames that were recorded before a start are invalid after this start, because the number
/// of the start has changed.
/// @verifies FR-264
TEST_F(SignedPortTest, FR264_FrameOfAnEarlierStartIsDropped) {
  FixedRandom other(kStartNumber + 1);
  SignedPort restarted(line, kSharedKey, other);
  line.arrive(device.sign(frames.hello()));
  EXPECT_TRUE(given(restarted).empty());
}

/// @brief The robot does not accept a frame that it has sent itself.
/// @verifies FR-262
TEST_F(SignedPortTest, FR262_OwnFrameIsNotAccepted) {
  ASSERT_TRUE(signedPort.write(frames.hello()));
  line.arrive(line.takeSent());
  EXPECT_TRUE(given().empty());
}

/// @brief A frame without counter and tag is dropped and answered with a challenge. The challenge
/// contains the number of the start and the last counter. With the challenge, a device can sign its
/// frames.
/// @verifies FR-262
TEST_F(SignedPortTest, FR262_WrongFrameIsAnsweredWithAChallenge) {
  line.arrive(device.signWith(9, frames.hello()));
  EXPECT_EQ(given().size(), 1U);
  line.arrive(frames.hello());
  EXPECT_TRUE(given().empty());
  const std::vector<scenario::Bytes> sent = scenario::bodies(line.takeSent());
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_EQ(sent[0].at(1), kChallengeType);
  const scenario::Bytes payload(sent[0].begin() + 3, sent[0].begin() + 15);
  EXPECT_EQ(payload, (scenario::Bytes{0xef, 0xcd, 0xab, 0x89, 0x67, 0x45, 0x23, 0x01, 9, 0, 0, 0}));
}

/// @brief Sent frames have correct tags. Their counters begin at 1.
/// @verifies FR-263
TEST_F(SignedPortTest, FR263_SentFramesAreSigned) {
  const scenario::Bytes hello = frames.hello();
  for (std::uint32_t counter = 1; counter <= 3; ++counter) {
    ASSERT_TRUE(signedPort.write(hello));
    const scenario::Bytes sent = line.takeSent();
    EXPECT_TRUE(device.verifies(counter, sent));
    EXPECT_EQ(scenario::Bytes(sent.begin(), sent.end() - 25),
              scenario::Bytes(hello.begin(), hello.end() - 1));
  }
}

/// @brief The firmware sends a single zero byte to end a frame that a reset has interrupted. The
/// port sends this byte unchanged and uses no counter for it.
/// @verifies FR-263
TEST_F(SignedPortTest, FR263_ZeroByteAloneIsSentAsItIs) {
  ASSERT_TRUE(signedPort.write(scenario::Bytes{0}));
  EXPECT_EQ(line.takeSent(), scenario::Bytes{0});
  ASSERT_TRUE(signedPort.write(frames.hello()));
  EXPECT_TRUE(device.verifies(1, line.takeSent()));
}

/// @brief The port returns the time of a frame, and the number of bytes that the serial line has
/// lost. It also returns the free space, without the bytes for counter and tag. If the serial line
/// has no space for a frame, the frame is not sent and uses no counter.
/// @verifies FR-263
/// @verifies FR-262
/// @verifies FR-20
/// @verifies FR-49
/// @verifies FR-247
TEST_F(SignedPortTest, FR263_PassesTimeRoomAndLossOfTheLineOn) {
  FakeTimebase time;
  line.setClock(time);
  time.advance(milliseconds(40));
  line.arrive(device.sign(frames.hello()));
  ASSERT_EQ(given().size(), 1U);
  EXPECT_EQ(signedPort.receivedAt(), Instant(40'000));
  line.arrive(scenario::Bytes(5000, 1));
  EXPECT_EQ(signedPort.lostBytes(), line.lostBytes());
  EXPECT_GT(signedPort.lostBytes(), 0);
  EXPECT_EQ(signedPort.free(), line.free() - SignedPort::kTrailer);
  const scenario::Bytes hello = frames.hello();
  std::uint32_t sent = 0;
  while (signedPort.write(hello)) {
    ++sent;
  }
  EXPECT_LT(line.free(), hello.size() + SignedPort::kTrailer);
  static_cast<void>(line.takeSent());
  ASSERT_TRUE(signedPort.write(hello));
  EXPECT_TRUE(device.verifies(sent + 1, line.takeSent()));
}

/// @brief A frame can be read in parts of any length.
/// @verifies FR-262
TEST_F(SignedPortTest, FR262_AFrameIsReadInParts) {
  const scenario::Bytes hello = frames.hello();
  line.arrive(device.sign(hello));
  scenario::Bytes frame;
  std::array<std::uint8_t, 3> part{};
  for (std::size_t count = signedPort.read(part); count > 0; count = signedPort.read(part)) {
    frame.insert(frame.end(), part.begin(), part.begin() + static_cast<std::ptrdiff_t>(count));
  }
  EXPECT_EQ(frame, hello);
}

/// @brief The port returns a frame with the greatest length. It drops a frame that is one byte
/// longer, even when its first bytes have a correct tag.
/// @verifies FR-262
TEST_F(SignedPortTest, FR262_TheLongestFrameIsGiven) {
  scenario::Bytes longest(FrameEncoder::kMaxBytes + 1, 7);
  longest.back() = 0;
  line.arrive(device.sign(longest));
  EXPECT_EQ(given(), std::vector<scenario::Bytes>{longest});
  scenario::Bytes tooLong = device.sign(longest);
  tooLong.insert(tooLong.end() - 1, '0');
  line.arrive(tooLong);
  EXPECT_TRUE(given().empty());
}

/// @brief A frame with the greatest length of the protocol is sent. A longer frame and an empty
/// frame are not sent.
/// @verifies FR-263
TEST_F(SignedPortTest, FR263_TheLongestFrameIsSent) {
  EXPECT_TRUE(signedPort.write(scenario::Bytes(FrameEncoder::kMaxBytes, 7)));
  EXPECT_TRUE(device.verifies(1, line.takeSent()));
  EXPECT_FALSE(signedPort.write(scenario::Bytes(FrameEncoder::kMaxBytes + 1, 7)));
  EXPECT_FALSE(signedPort.write(scenario::Bytes{}));
  EXPECT_TRUE(line.takeSent().empty());
}

/// @brief Each dropped frame is answered with a challenge, for any kind of error. A single zero
/// byte is not a frame, and is not answered.
/// @verifies FR-262
TEST_F(SignedPortTest, FR262_EachDroppedFrameIsAnswered) {
  line.arrive(device.signWith(9, frames.hello()));
  EXPECT_EQ(given().size(), 1U);
  scenario::Bytes wrongTag = device.signWith(10, frames.hello());
  wrongTag[wrongTag.size() - 2] ^= 1U;
  for (const scenario::Bytes& wrong :
       {device.signWith(9, frames.hello()), wrongTag, device.signWith(10, scenario::Bytes{0}),
        scenario::Bytes{3, 0}, scenario::Bytes(1000, 1)}) {
    line.arrive(wrong);
    line.arrive(scenario::Bytes{0, 0});
    EXPECT_TRUE(given().empty()) << wrong.size();
    EXPECT_EQ(scenario::bodies(line.takeSent()).size(), 1U) << wrong.size();
  }
}

/// @brief A zero byte precedes the first challenge, because a reset may have interrupted a frame.
/// The next challenge follows without a zero byte.
/// @verifies FR-247
TEST_F(SignedPortTest, FR247_TheFirstChallengeFollowsAZeroByte) {
  line.arrive(frames.hello());
  EXPECT_TRUE(given().empty());
  const scenario::Bytes first = line.takeSent();
  EXPECT_EQ(first.at(0), 0);
  line.arrive(frames.hello());
  EXPECT_TRUE(given().empty());
  EXPECT_EQ(line.takeSent(), scenario::Bytes(first.begin() + 1, first.end()));
}

/// @brief A challenge is sent only when there is space for two frames of the greatest size, each
/// with its counter and its tag. After the challenge, there is still space for one frame.
/// @verifies FR-262
TEST_F(SignedPortTest, FR262_AChallengeLeavesRoomForAFrame) {
  FakeSerialPort port;
  SignedPort narrow(port, kSharedKey, random);
  for (const std::size_t missing : {std::size_t{1}, std::size_t{0}}) {
    port.room = 2 * (FrameEncoder::kMaxBytes + SignedPort::kTrailer) - missing;
    port.received = frames.hello();
    EXPECT_TRUE(given(narrow).empty());
    EXPECT_EQ(port.sent.empty(), missing > 0);
  }
}

/// A serial line on which bytes arrive faster than they can be read.
class FloodedPort final : public SerialPort {
 public:
  explicit FloodedPort(std::size_t atOnce) : atOnce_(atOnce) {}

  std::size_t read(std::span<std::uint8_t> bytes) override {
    ++reads;
    const auto filled = bytes.first(std::min(bytes.size(), atOnce_));
    std::ranges::fill(filled, std::uint8_t{1});
    return filled.size();
  }
  [[nodiscard]] Instant receivedAt() const override { return {}; }
  [[nodiscard]] std::size_t free() const override { return 0; }
  bool write(std::span<const std::uint8_t> /*bytes*/) override { return false; }
  [[nodiscard]] std::uint16_t lostBytes() const override { return 0; }

  int reads = 0;

 private:
  std::size_t atOnce_;
};

/// @brief A call of read() reads at most 64 parts of 64 bytes. Therefore the call ends even if the
/// serial line never becomes empty. An empty serial line is read once.
/// @verifies FR-262
TEST_F(SignedPortTest, FR262_AReadEndsInAFlood) {
  for (const auto& [atOnce, reads] : {std::pair<std::size_t, int>{64, 64}, {1, 64}, {0, 1}}) {
    FloodedPort port(atOnce);
    SignedPort flooded(port, kSharedKey, random);
    std::array<std::uint8_t, 64> bytes{};
    EXPECT_EQ(flooded.read(bytes), 0U);
    EXPECT_EQ(port.reads, reads) << atOnce;
  }
}

/// @brief Without a key or without a random number, the port returns no frame and sends no frame,
/// not even a challenge.
/// @verifies FR-265
TEST_F(SignedPortTest, FR265_WithoutKeyNothingIsReceivedOrSent) {
  FixedRandom broken(std::nullopt);
  SignedPort keyless(line, erased(), random);
  SignedPort numberless(line, kSharedKey, broken);
  SigningDevice finder(erased(), kStartNumber);
  for (SignedPort* port : {&keyless, &numberless}) {
    line.arrive(finder.sign(frames.hello()));
    line.arrive(device.sign(frames.hello()));
    EXPECT_TRUE(given(*port).empty());
    EXPECT_FALSE(port->write(frames.hello()));
    EXPECT_TRUE(line.takeSent().empty());
  }
}

/// @brief A frame is dropped if it is too long, or if its tag contains a character that is not a
/// hexadecimal digit. The next correct frame is returned.
/// @verifies FR-262
TEST_F(SignedPortTest, FR262_StrangeBytesAreDropped) {
  line.arrive(scenario::Bytes(1000, 1));
  line.arrive(scenario::Bytes{0, 0, 3, 0});
  scenario::Bytes upperCase = device.sign(frames.hello());
  upperCase[upperCase.size() - 2] = 'G';
  line.arrive(upperCase);
  EXPECT_TRUE(given().empty());
  line.arrive(device.sign(frames.hello()));
  EXPECT_EQ(given().size(), 1U);
}

}  // namespace
}  // namespace wr::test
