#include "sim/scenario/HostLine.hpp"

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

std::optional<LineFinding> HostLine::finding() const {
  return std::nullopt;
}

}  // namespace wr
