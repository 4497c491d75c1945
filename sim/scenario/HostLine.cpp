#include "sim/scenario/HostLine.hpp"

#include <array>
#include <cstdint>

namespace wr {

HostLine::HostLine(HostEquipment equipment) : world(port, equipment) {
  port.setClock(world.time);
}

void HostLine::start() {
  world.start();
}

void HostLine::send(std::span<const std::uint8_t> bytes) {
  port.arrive(bytes);
}

void HostLine::sendBeforePulse(std::span<const std::uint8_t> bytes, Time before) {
  world.runUntil(world.nextPulse() + Microseconds(-before.count()));
  send(bytes);
}

std::vector<std::uint8_t> HostLine::takeSent() {
  return port.takeSent();
}

bool HostLine::runUntil(Time instant) {
  world.runUntil(Instant(static_cast<std::uint64_t>(instant.count())));
  return true;
}

bool HostLine::runThroughPulse() {
  world.runUntil(world.nextPulse());
  return true;
}

RobotLine::Time HostLine::now() const {
  return Time(world.time.now().sinceStart());
}

sim::Robot& HostLine::robot() {
  return world.physics;
}

sim::RemoteControl& HostLine::remoteControl() {
  return world.remoteControl;
}

// Bytes that the firmware has not read yet are lost with its buffer.
void HostLine::reset(ResetKind kind) {
  std::array<std::uint8_t, 64> lost{};
  while (port.read(lost) > 0) {
  }
  world.reset(kind == ResetKind::Power ? ResetCause::PowerOn : ResetCause::Pin);
}

std::optional<LineFinding> HostLine::finding() const {
  return std::nullopt;
}

}  // namespace wr
