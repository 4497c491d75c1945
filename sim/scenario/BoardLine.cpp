#include "sim/scenario/BoardLine.hpp"

#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

namespace wr {

namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr std::uint32_t kExceptionOfFirstInterrupt = 16;
constexpr milliseconds kPeriod{100};
// A start takes less, and so does everything between two pulses.
constexpr milliseconds kLongest{1000};
// One start bit, eight data bits and one stop bit at 115200 baud.
constexpr nanoseconds kByte{86'806};

}  // namespace

BoardLine::BoardLine(std::vector<std::uint8_t> image, k64::Options options)
    : board(std::move(image), std::move(options)), binding_(board) {
  board.onEvent([this](const k64::Event& event) {
    if (event.kind == k64::Event::Kind::ExceptionEntered &&
        event.number == kExceptionOfFirstInterrupt + kPulseInterrupt) {
      pulses_.push_back(event.at);
    }
    binding_.take(event);
    if (observer_) {
      observer_(event);
    }
  });
}

void BoardLine::onEvent(std::function<void(const k64::Event&)> call) {
  observer_ = std::move(call);
}

void BoardLine::send(std::span<const std::uint8_t> bytes) {
  board.receive(bytes);
}

void BoardLine::sendBeforePulse(std::span<const std::uint8_t> bytes, Time before) {
  if (pulses_.empty()) {
    throw std::logic_error("no clock pulse has come yet");
  }
  const nanoseconds end = pulses_.back() + kPeriod - before;
  board.receiveAt(end - kByte * static_cast<std::int64_t>(bytes.size()), bytes);
}

std::vector<std::uint8_t> BoardLine::takeSent() {
  return board.takeSent();
}

bool BoardLine::runUntil(Time instant) {
  return board.runUntil(instant);
}

bool BoardLine::runThroughPulse() {
  if (!board.runToInterrupt(kPulseInterrupt, board.now() + kLongest)) {
    if (!board.finding()) {
      throw std::runtime_error("no clock pulse in 1 s");
    }
    return false;
  }
  return settle();
}

// The cycle has run when the processor sleeps, and its report is on the line when the line is idle.
bool BoardLine::settle() {
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

RobotLine::Time BoardLine::now() const {
  return std::chrono::duration_cast<Time>(board.now());
}

sim::Robot& BoardLine::robot() {
  return binding_.physics;
}

sim::RemoteControl& BoardLine::remoteControl() {
  return binding_.remoteControl;
}

void BoardLine::reset(ResetKind kind) {
  board.reset(kind == ResetKind::Power ? k64::Reset::PowerOn : k64::Reset::Pin);
}

void BoardLine::setExternalClock(bool present) {
  board.setExternalClock(present);
}

std::optional<LineFinding> BoardLine::finding() const {
  const std::optional<k64::Finding>& found = board.finding();
  if (!found) {
    return std::nullopt;
  }
  std::string text = found->id + ": " + found->what;
  text += ", in " + (found->function.empty() ? "an unnamed function" : found->function);
  text += " at " + (found->place.empty() ? "an unknown place" : found->place);
  const auto us = std::chrono::duration_cast<microseconds>(found->at).count();
  text +=
      ", " + std::to_string(us / 1000) + "." + std::to_string(1000 + us % 1000).substr(1) + " ms";
  return LineFinding{.id = found->id, .text = std::move(text)};
}

std::vector<std::uint8_t> readImage(const std::filesystem::path& file) {
  std::ifstream input(file, std::ios::binary);
  std::vector<std::uint8_t> image{std::istreambuf_iterator<char>(input),
                                  std::istreambuf_iterator<char>()};
  if (image.empty()) {
    throw std::runtime_error("there is no image at " + file.string() +
                             ": build the firmware for the K64 first");
  }
  return image;
}

}  // namespace wr
