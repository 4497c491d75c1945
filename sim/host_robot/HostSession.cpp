#include "sim/host_robot/HostSession.hpp"

#include <array>
#include <cstdint>

namespace wr::host_robot {

HostSession::HostSession(host::HostEquipment equipment) : world(port, equipment) {
  port.setClock(world.time);
}

void HostSession::start() {
  world.start();
}

void HostSession::send(std::span<const std::uint8_t> bytes) {
  port.arrive(bytes);
}

void HostSession::sendBeforePulse(std::span<const std::uint8_t> bytes, Time before) {
  world.runUntil(world.nextPulse() + Microseconds(-before.count()));
  send(bytes);
}

std::vector<std::uint8_t> HostSession::takeSent() {
  return port.takeSent();
}

bool HostSession::runUntil(Time instant) {
  world.runUntil(Instant(static_cast<std::uint64_t>(instant.count())));
  return true;
}

bool HostSession::runThroughPulse() {
  world.runUntil(world.nextPulse());
  return true;
}

scenario::RobotSession::Time HostSession::now() const {
  return Time(world.time.now().sinceStart());
}

plant::Robot& HostSession::robot() {
  return world.physics;
}

plant::RemoteControl& HostSession::remoteControl() {
  return world.remoteControl;
}

// A reset discards the bytes that the firmware has not read yet.
void HostSession::reset(scenario::ResetKind kind) {
  std::array<std::uint8_t, 64> lost{};
  while (port.read(lost) > 0) {
  }
  world.reset(kind == scenario::ResetKind::Power ? ResetCause::PowerOn : ResetCause::Pin);
}

std::optional<scenario::SessionFinding> HostSession::finding() const {
  return std::nullopt;
}

}  // namespace wr::host_robot
