#include "sim/host/HostWorld.hpp"

#include <algorithm>
#include <chrono>

namespace wr {

namespace {

constexpr std::uint32_t kSeed = 1;
constexpr Microseconds kBeat = milliseconds(1);

// The microsecond that an edge is in; the firmware's clock has no finer time.
Instant at(Instant begin, std::chrono::nanoseconds offset) {
  return begin +
         Microseconds(std::chrono::duration_cast<std::chrono::microseconds>(offset).count());
}

}  // namespace

HostWorld::HostWorld(SerialPort& pcPort, HostEquipment equipment)
    : robot(time, pcPort, {}, equipment),
      physics(kSeed),
      equipment_(equipment),
      binding_(robot.pins(), physics) {
  binding_.measure();
}

void HostWorld::start() {
  robot.start();
  nextBeat_ = time.now() + (equipment_ == HostEquipment::Whole ? kBeat : robot.period());
  nextPulse_ = time.now() + robot.period();
}

void HostWorld::runUntil(Instant instant) {
  while (nextBeat_ <= instant) {
    bringEdges(nextBeat_ + Microseconds(-1));
    advanceTo(nextBeat_);
    beat();
  }
  bringEdges(instant);
  advanceTo(instant);
}

void HostWorld::beat() {
  const Instant now = nextBeat_;
  if (equipment_ == HostEquipment::MainControl) {
    nextBeat_ = now + robot.period();
    pulseWhenDue();
    return;
  }
  nextBeat_ = now + kBeat;
  binding_.drive();
  for (const sim::HallEdge& edge : physics.step()) {
    HostWheelPins& pins = robot.pins().wheels.at(edge.wheel);
    edges_.push_back({at(now, edge.offset), &pins.hall.at(edge.sensor), edge.level});
  }
  for (const sim::RcEdge& edge : remoteControl.step()) {
    HostEdgeInput& pin = robot.pins().remoteControl.at(edge.channel);
    edges_.push_back({at(now, edge.offset), &pin, edge.level});
  }
  std::ranges::stable_sort(edges_, {}, &Edge::at);
  binding_.measure();
  robot.beat();
  pulseWhenDue();
}

void HostWorld::pulseWhenDue() {
  if (time.now() >= nextPulse_) {
    nextPulse_ = time.now() + robot.period();
    robot.clockPulse();
  }
}

void HostWorld::bringEdges(Instant until) {
  const auto end = std::ranges::upper_bound(edges_, until, {}, &Edge::at);
  for (auto edge = edges_.begin(); edge != end; ++edge) {
    advanceTo(edge->at);
    edge->pin->drive(edge->level);
  }
  edges_.erase(edges_.begin(), end);
}

void HostWorld::advanceTo(Instant instant) {
  if (instant > time.now()) {
    time.advance(instant - time.now());
  }
}

}  // namespace wr
