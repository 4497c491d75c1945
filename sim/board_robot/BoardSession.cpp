#include "sim/board_robot/BoardSession.hpp"

#include <stdexcept>
#include <utility>

namespace wr::board_robot {

namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::uint32_t kExceptionOfFirstInterrupt = 16;
constexpr milliseconds kPeriod{100};
// Longest wait for the next clock pulse. A start of the firmware and a control cycle always take
// less time.
constexpr milliseconds kLongest{1000};
// One start bit, eight data bits and one stop bit at 115200 baud.
constexpr nanoseconds kByte{86'806};

}  // namespace

BoardSession::BoardSession(std::vector<std::uint8_t> image, emulator::Options options)
    : board(std::move(image), std::move(options)), binding_(board) {
  board.onEvent([this](const emulator::Event& event) {
    if (event.kind == emulator::Event::Kind::ExceptionEntered &&
        event.number == kExceptionOfFirstInterrupt + kPulseInterrupt) {
      pulses_.push_back(event.at);
    }
    binding_.take(event);
    if (observer_) {
      observer_(event);
    }
  });
}

void BoardSession::onEvent(std::function<void(const emulator::Event&)> call) {
  observer_ = std::move(call);
}

void BoardSession::send(std::span<const std::uint8_t> bytes) {
  board.receive(bytes);
}

void BoardSession::sendBeforePulse(std::span<const std::uint8_t> bytes, Time before) {
  if (pulses_.empty()) {
    throw std::logic_error("there has been no clock pulse yet");
  }
  const nanoseconds end = pulses_.back() + kPeriod - before;
  board.receiveAt(end - kByte * static_cast<std::int64_t>(bytes.size()), bytes);
}

std::vector<std::uint8_t> BoardSession::takeSent() {
  return board.takeSent();
}

bool BoardSession::runUntil(Time instant) {
  return board.runUntil(instant);
}

bool BoardSession::runThroughPulse() {
  if (!board.runToInterrupt(kPulseInterrupt, board.now() + kLongest)) {
    if (!board.finding()) {
      throw std::runtime_error(
          "there was no clock pulse in 1 s; check that the firmware image is an image of the "
          "robot");
    }
    return false;
  }
  return settle();
}

// When the processor sleeps, the cycle has ended. When the serial line is idle, the report of the
// cycle has been sent.
bool BoardSession::settle() {
  const nanoseconds limit = pulses_.back() + kPeriod;
  if (!board.runToSleep(limit)) {
    return !board.finding();
  }
  while (!board.lineIdle() && board.now() < limit - milliseconds(1)) {
    if (!board.runUntil(board.now() + microseconds(100))) {
      return false;
    }
  }
  return true;
}

scenario::RobotSession::Time BoardSession::now() const {
  return std::chrono::duration_cast<Time>(board.now());
}

plant::Robot& BoardSession::robot() {
  return binding_.physics;
}

plant::RemoteControl& BoardSession::remoteControl() {
  return binding_.remoteControl;
}

void BoardSession::reset(scenario::ResetKind kind) {
  board.reset(kind == scenario::ResetKind::Power ? emulator::Reset::PowerOn : emulator::Reset::Pin);
}

void BoardSession::setExternalClock(bool present) {
  board.setExternalClock(present);
}

std::optional<scenario::SessionFinding> BoardSession::finding() const {
  const std::optional<emulator::Finding>& found = board.finding();
  if (!found) {
    return std::nullopt;
  }
  return scenario::SessionFinding{.id = found->id, .text = emulator::textOf(*found)};
}

}  // namespace wr::board_robot
