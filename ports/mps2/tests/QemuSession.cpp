#include "ports/mps2/tests/QemuSession.hpp"

#include <chrono>
#include <stdexcept>

#include "ports/mps2/registers.hpp"
#include "services/SystemConstants.hpp"

namespace wr::mps2 {
namespace {

constexpr std::uint32_t kCounter = 0x40002004;  // register VALUE of the dual timer
constexpr scenario::RobotSession::Time kPeriod{SystemConstants::instance().cyclePeriod().count()};

// QEMU stops the program for each byte. If the host computer is busy, the emulated time can
// continue during such a stop. Therefore the bytes are sent early: then the clock pulse does not
// occur before the last byte of a frame.
constexpr scenario::RobotSession::Time kEarlier{80'000};

}  // namespace

QemuSession::QemuSession(const std::filesystem::path& elf)
    : symbols_(elf),
      rest_(placeOf("rest")),
      tick_(placeOf("tickTimerInterrupt")),
      cycle_(placeOf("mainThreadInterrupt")),
      end_(placeOf("unexpected")),
      emulator_(elf) {
  emulator_.replaceByNothing(placeOf("awake") - Emulator::kShort);
  run({rest_});
}

std::uint32_t QemuSession::placeOf(const std::string& symbol) const {
  constexpr std::uint32_t kThumb = 1;
  return symbols_.addressOf(symbol) & ~kThumb;
}

void QemuSession::run(std::initializer_list<std::uint32_t> places) {
  place_ = emulator_.runTo(places);
  const std::uint32_t counter = emulator_.word(kCounter);
  ticks_ += counter_ - counter;
  counter_ = counter;
  now_ = Time(static_cast<Time::rep>(ticks_ / kTicksPerMicrosecond));
  // The clock pulse triggers the main thread. Therefore this thread begins at the time of the clock
  // pulse.
  if (place_ == cycle_) {
    lastPulse_ = now_;
    run({rest_, end_});
  }
}

void QemuSession::send(std::span<const std::uint8_t> bytes) {
  emulator_.send(bytes, rest_);
}

void QemuSession::sendBeforePulse(std::span<const std::uint8_t> bytes, Time before) {
  if (runUntil(lastPulse_ + kPeriod - before - kEarlier)) {
    send(bytes);
    run({rest_, cycle_, end_});
    if (now_ >= lastPulse_ + kPeriod) {
      throw std::runtime_error(
          "the clock pulse occurred before the robot received all bytes: run the test again "
          "when the host computer is less busy");
    }
  }
}

std::vector<std::uint8_t> QemuSession::takeSent() {
  return emulator_.takeSent();
}

bool QemuSession::runUntil(Time instant) {
  while (now_ < instant && place_ != end_) {
    run({tick_, cycle_, end_});
    if (place_ == tick_) {
      run({rest_, cycle_, end_});
    }
  }
  return place_ != end_;
}

// When the program is at rest after the clock pulse, all threads have ended and all bytes have been
// sent.
bool QemuSession::runThroughPulse() {
  if (place_ != end_) {
    run({cycle_, end_});
  }
  return place_ != end_;
}

plant::Robot& QemuSession::robot() {
  throw std::logic_error("the board on QEMU has no motors and no sensors");
}

plant::RemoteControl& QemuSession::remoteControl() {
  throw std::logic_error("the board on QEMU has no remote control");
}

std::optional<scenario::SessionFinding> QemuSession::finding() const {
  if (place_ != end_) {
    return std::nullopt;
  }
  return scenario::SessionFinding{
      .id = "ended", .text = "the firmware has ended after a fault: it has called unexpected()"};
}

}  // namespace wr::mps2
