#include "sim/scenario/HostLine.hpp"

namespace wr {

HostLine::HostLine() : robot(time, port) {}

void HostLine::start() {
  robot.start();
  nextPulse_ = now() + period();
}

void HostLine::send(std::span<const std::uint8_t> bytes) {
  port.arrive(bytes);
}

void HostLine::sendBeforePulse(std::span<const std::uint8_t> bytes, Time before) {
  advanceTo(nextPulse_ - before);
  send(bytes);
}

std::vector<std::uint8_t> HostLine::takeSent() {
  return port.takeSent();
}

bool HostLine::runUntil(Time instant) {
  while (nextPulse_ <= instant) {
    runThroughPulse();
  }
  advanceTo(instant);
  return true;
}

bool HostLine::runThroughPulse() {
  advanceTo(nextPulse_);
  nextPulse_ = now() + period();
  robot.clockPulse();
  return true;
}

RobotLine::Time HostLine::now() const {
  return Time(time.now().sinceStart());
}

std::optional<LineFinding> HostLine::finding() const {
  return std::nullopt;
}

RobotLine::Time HostLine::period() const {
  return Time(robot.period().count());
}

void HostLine::advanceTo(Time instant) {
  if (instant > now()) {
    time.advance(Microseconds((instant - now()).count()));
  }
}

}  // namespace wr
