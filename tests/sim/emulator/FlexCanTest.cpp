#include "sim/emulator/FlexCan.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

namespace wr::emulator {
namespace {

// The addresses and bits of this test are from the memory map and the register descriptions of the
// reference manual K64P144M120SF5RM, chapter CAN (FlexCAN).
constexpr std::uint32_t kMcr = 0x00;
constexpr std::uint32_t kCtrl1 = 0x04;
constexpr std::uint32_t kTimer = 0x08;
constexpr std::uint32_t kImask1 = 0x28;
constexpr std::uint32_t kIflag1 = 0x30;
constexpr std::uint32_t kBuffer0 = 0x80;
constexpr std::uint32_t kBuffer1 = 0x90;
constexpr std::uint32_t kBuffer2 = 0xA0;
constexpr unsigned kLine = 75;
// 60 MHz / 6 / 20 quanta are 500 kbit/s
constexpr std::uint32_t kTiming = 0x05BA2007;

class Surroundings final : public Microcontroller {
 public:
  Surroundings() { bus.set(Time(0), 60'000'000); }

  [[nodiscard]] Time time() const override { return now; }
  [[nodiscard]] const Clock& coreClock() const override { return bus; }
  [[nodiscard]] const Clock& busClock() const override { return bus; }
  void setLine(unsigned line, bool level) override { high = line == kLine && level; }
  void raiseNmi() override {}
  void clocksChanged() override {}
  void report(std::string id, std::string text) override { findings.push_back(id + ": " + text); }
  void refuse(std::string id, std::string text) override { report(std::move(id), std::move(text)); }
  void requestReset(Reset /*cause*/, std::string /*id*/, std::string /*text*/) override {}
  void tell(Event::Kind /*kind*/, std::uint32_t /*number*/, std::uint32_t /*value*/) override {}

  Clock bus;
  Time now{0};
  bool high = false;
  std::vector<std::string> findings;
};

class CanOfTheBoard : public testing::Test {
 protected:
  CanOfTheBoard() {
    can.connectPins([this] { return connected; });
  }

  // Configures the controller. Buffer 1 receives the identifier 0x101, and buffer 2 sends the
  // identifier 0x102.
  void bringUp() {
    can.write(kCtrl1, 4, 0x2000);
    can.write(kMcr, 4, 0x50020002);
    EXPECT_EQ(can.read(kMcr, 4) & 0x01000000, 0x01000000U) << "FRZACK";
    can.write(kCtrl1, 4, kTiming);
    can.write(kBuffer1 + 4, 4, 0x101U << 18U);
    can.write(kBuffer2 + 4, 4, 0x102U << 18U);
    can.write(kBuffer1, 4, 0x04000000);
    can.write(kImask1, 4, 0x6);
    can.write(kMcr, 4, 0x00020002);
    EXPECT_EQ(can.read(kMcr, 4) & 0x08000000, 0U) << "NOTRDY";
  }

  // Sends the frame in buffer 2, with the workaround for erratum 5829 of the controller.
  void activate(std::uint32_t control) {
    can.write(kBuffer2, 4, control);
    can.write(kBuffer0, 4, 0x08000000);
    can.write(kBuffer0, 4, 0x08000000);
  }

  void pass(std::chrono::microseconds duration) {
    now.now += duration;
    can.advance();
  }

  Surroundings now;
  bool connected = true;
  FlexCan can{now};
};

/// @brief The transfer of a frame with 8 data bytes takes the time of 111 bits. After the transfer,
/// the buffer of the frame is inactive, and the flag of the buffer requests an interrupt until the
/// program clears this flag.
TEST_F(CanOfTheBoard, SendsAFrame) {
  bringUp();
  can.write(kBuffer2 + 8, 4, 0x01020304);
  can.write(kBuffer2 + 12, 4, 0x05060708);
  activate(0x0C080000);
  pass(std::chrono::microseconds(221));
  EXPECT_FALSE(now.high);
  pass(std::chrono::microseconds(2));
  EXPECT_TRUE(now.high);
  EXPECT_EQ(can.read(kIflag1, 4), 4U);
  EXPECT_EQ(can.read(kBuffer2, 4) >> 24U, 8U);
  can.write(kIflag1, 4, 4);
  EXPECT_FALSE(now.high);
  const std::vector<CanFrame> sent = can.takeSent();
  ASSERT_EQ(sent.size(), 1U);
  EXPECT_EQ(sent[0].identifier, 0x102);
  EXPECT_EQ(sent[0].data, (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_TRUE(now.findings.empty());
}

/// @brief A buffer stores only frames with its own identifier.
TEST_F(CanOfTheBoard, ReceivesTheFramesOfItsIdentifier) {
  bringUp();
  can.arrive({.identifier = 0x100, .data = {9}});
  pass(std::chrono::milliseconds(1));
  EXPECT_FALSE(now.high);
  can.arrive({.identifier = 0x101, .data = {0xA1, 0xB2, 0xC3}});
  pass(std::chrono::milliseconds(1));
  EXPECT_TRUE(now.high);
  EXPECT_EQ(can.read(kBuffer1, 4), 0x02030000U);
  EXPECT_EQ(can.read(kBuffer1 + 8, 4), 0xA1B2C300U);
}

/// @brief If a frame arrives before the program has read the previous frame, the new frame
/// overwrites the previous frame. The status code of the buffer shows this.
TEST_F(CanOfTheBoard, ShowsALostFrame) {
  bringUp();
  can.arrive({.identifier = 0x101, .data = {1}});
  can.arrive({.identifier = 0x101, .data = {2}});
  pass(std::chrono::milliseconds(1));
  EXPECT_EQ(can.read(kBuffer1, 4) >> 24U, 6U);
  can.write(kIflag1, 4, 2);
  static_cast<void>(can.read(kTimer, 4));
  can.arrive({.identifier = 0x101, .data = {3}});
  pass(std::chrono::milliseconds(1));
  EXPECT_EQ(can.read(kBuffer1, 4) >> 24U, 2U);
  EXPECT_EQ(can.read(kBuffer1 + 8, 4), 0x03000000U);
}

/// @brief The buffer is locked when the program reads its control word. If a frame arrives while
/// the buffer is locked, the frame waits until the timer is read. The flag of the buffer is set
/// when the frame is moved into the buffer.
TEST_F(CanOfTheBoard, FrameForALockedBufferWaits) {
  bringUp();
  can.arrive({.identifier = 0x101, .data = {1}});
  pass(std::chrono::milliseconds(1));
  EXPECT_EQ(can.read(kBuffer1, 4) >> 24U, 2U);
  can.arrive({.identifier = 0x101, .data = {2}});
  pass(std::chrono::milliseconds(1));
  EXPECT_EQ(can.read(kBuffer1 + 8, 4), 0x01000000U);
  can.write(kIflag1, 4, 2);
  EXPECT_FALSE(now.high);
  static_cast<void>(can.read(kTimer, 4));
  EXPECT_TRUE(now.high);
  EXPECT_EQ(can.read(kBuffer1, 4) >> 24U, 2U) << "the first frame was read, so no frame is lost";
  EXPECT_EQ(can.read(kBuffer1 + 8, 4), 0x02000000U);
  EXPECT_TRUE(now.findings.empty());
}

/// @brief A program must clear the flag of a buffer before it unlocks this buffer. Otherwise, a
/// waiting frame sets the flag again, and the program then clears the flag of this new frame. The
/// mistake causes a finding, even if no frame waits.
TEST_F(CanOfTheBoard, FindsABufferThatIsUnlockedBeforeItsFlagIsCleared) {
  bringUp();
  can.arrive({.identifier = 0x101, .data = {1}});
  pass(std::chrono::milliseconds(1));
  static_cast<void>(can.read(kBuffer1, 4));
  static_cast<void>(can.read(kTimer, 4));
  EXPECT_EQ(now.findings.size(), 1U);
  static_cast<void>(can.read(kTimer, 4));
  EXPECT_EQ(now.findings.size(), 1U) << "no buffer is locked";
}

/// @brief Of two frames that wait for the bus, the frame with the smaller identifier is sent first.
TEST_F(CanOfTheBoard, TheSmallerIdentifierWinsTheBus) {
  bringUp();
  can.arrive({.identifier = 0x7FF, .data = {}});
  activate(0x0C010000);
  can.arrive({.identifier = 0x101, .data = {1}});
  pass(std::chrono::microseconds(100));
  EXPECT_EQ(can.read(kIflag1, 4), 0U);
  pass(std::chrono::microseconds(110));
  EXPECT_EQ(can.read(kIflag1, 4), 2U)
      << "the second frame of the other node is sent before the frame of the controller";
  pass(std::chrono::milliseconds(1));
  EXPECT_EQ(can.read(kIflag1, 4), 6U);
}

/// @brief Erratum 5829 of the controller: after the activation of a buffer, the program must write
/// the code INACTIVE to buffer 0 twice. If a frame is sent without these writes, this causes a
/// finding.
TEST_F(CanOfTheBoard, FindsAFrameWithoutTheWritesToBufferZero) {
  bringUp();
  activate(0x0C010000);
  pass(std::chrono::milliseconds(1));
  EXPECT_TRUE(now.findings.empty());
  can.write(kBuffer2, 4, 0x0C010000);
  can.write(kBuffer0, 4, 0x08000000);
  pass(std::chrono::milliseconds(1));
  ASSERT_EQ(now.findings.size(), 1U);
  EXPECT_NE(now.findings[0].find("5829"), std::string::npos);
}

/// @brief The manual forbids four actions, and each of them causes a finding: writing the timing
/// outside of the freeze mode, writing the clock source while the controller is enabled, writing a
/// buffer while the controller is disabled, and sending a frame without pins.
TEST_F(CanOfTheBoard, FindsWhatTheManualForbids) {
  can.write(kBuffer1, 4, 0x04000000);
  EXPECT_EQ(now.findings.size(), 1U) << "the buffer was written while the controller was disabled";
  bringUp();
  can.write(kCtrl1, 4, kTiming + 1);
  EXPECT_EQ(now.findings.size(), 2U) << "the timing was written outside of the freeze mode";
  can.write(kCtrl1, 4, kTiming & ~0x2000U);
  EXPECT_EQ(now.findings.size(), 3U)
      << "the clock source was written while the controller was enabled";
  connected = false;
  can.write(kBuffer2, 4, 0x0C010000);
  EXPECT_EQ(now.findings.size(), 4U) << "a frame was sent without pins";
}

}  // namespace
}  // namespace wr::emulator
