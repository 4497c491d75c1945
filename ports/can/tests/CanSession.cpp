#include "ports/can/tests/CanSession.hpp"

#include <algorithm>
#include <chrono>

namespace wr::can {
namespace {

// The tests define these numbers themselves, and do not use the constants of the firmware.
// Therefore a wrong number in the firmware makes the tests fail.
constexpr std::uint16_t kToRobot = 0x101;
constexpr std::uint16_t kFromRobot = 0x102;
constexpr std::size_t kMost = 8;  // greatest number of bytes in a frame
constexpr std::chrono::milliseconds kPeriod{100};

// A frame with 8 bytes has 111 bits. The virtual K64 sends no stuff bits. Each bit takes 2 us.
constexpr std::chrono::microseconds kLongestFrame{222};

}  // namespace

void CanSession::send(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const auto part = bytes.first(std::min(bytes.size(), kMost));
    all_->board.receiveCan({.identifier = kToRobot, .data = {part.begin(), part.end()}});
    bytes = bytes.subspan(part.size());
  }
}

void CanSession::sendBeforePulse(std::span<const std::uint8_t> bytes, Time before) {
  const auto frames = static_cast<std::int64_t>((bytes.size() + kMost - 1) / kMost);
  const auto pulse = std::chrono::duration_cast<Time>(all_->pulses().back() + kPeriod);
  if (all_->runUntil(pulse - before - kLongestFrame * frames)) {
    send(bytes);
  }
}

std::vector<std::uint8_t> CanSession::takeSent() {
  std::vector<std::uint8_t> bytes;
  for (const emulator::CanFrame& frame : all_->board.takeSentCan()) {
    if (frame.identifier == kFromRobot) {
      bytes.insert(bytes.end(), frame.data.begin(), frame.data.end());
    }
  }
  return bytes;
}

bool CanSession::runThroughPulse() {
  if (!all_->runThroughPulse()) {
    return false;
  }
  const auto limit = std::chrono::duration_cast<Time>(all_->pulses().back() + kPeriod / 2);
  // Between two frames of the robot the bus is idle for a short time, until the robot has served
  // its interrupt. Therefore the bus must be idle at two successive checks.
  for (int idle = 0; idle < 2 && now() < limit; idle = all_->board.canIdle() ? idle + 1 : 0) {
    if (!all_->runUntil(now() + std::chrono::microseconds(100))) {
      return false;
    }
  }
  return true;
}

}  // namespace wr::can
