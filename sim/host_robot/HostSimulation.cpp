#include "sim/host_robot/HostSimulation.hpp"

#include <algorithm>
#include <chrono>
#include <memory>

namespace wr::host_robot {

namespace {

constexpr std::uint32_t kSeed = 1;
constexpr Microseconds kStep(std::chrono::microseconds(plant::Robot::kStep).count());

// The time from power-on to the start of the timers. In this time, the clock starts, the converters
// are calibrated, and the objects are constructed. The time was measured with the firmware image on
// the virtual K64.
constexpr Microseconds kStartUp(5364);

// On the K64, each control cycle begins just after a tick. kToPulse is the time from this tick to
// the clock pulse. kOfWheel is the time from the clock pulse to the start of the first wheel
// thread. Both times were measured with a firmware image on the virtual K64. They vary with the
// image and with the cycle. On the host, code takes no time. Therefore the simulation delays the
// clock pulse by kToPulse after the tick, and delays the start of each wheel thread by kOfWheel.
// In the simulation, the time between the starts of two wheel threads is longer than on the K64.
constexpr Microseconds kToPulse(9);
constexpr Microseconds kOfWheel(51);

// Rounds the time of an edge down to whole microseconds, which are the resolution of the firmware's
// clock.
Instant at(Instant begin, std::chrono::nanoseconds offset) {
  return begin +
         Microseconds(std::chrono::duration_cast<std::chrono::microseconds>(offset).count());
}

}  // namespace

HostSimulation::HostSimulation(SerialPort& pcPort, host::HostEquipment equipment)
    : robot(time, pcPort, {}, equipment),
      physics(kSeed),
      pcPort_(pcPort),
      equipment_(equipment),
      binding_(robot.pins(), physics) {
  observeThreads();
}

void HostSimulation::observeThreads() {
  robot.scheduler().beforeThread([this](const host::HostThread& thread) {
    if (thread.priority() == host::HostFirmware::kWheelPriority) {
      pass(time.now() + kOfWheel);
    }
  });
}

void HostSimulation::start() {
  robot.start();
  nextStep_ = time.now() + kStep;
  beginPeriods();
}

void HostSimulation::beginPeriods() {
  const Instant begin = time.now() + kStartUp;
  nextTick_ = begin + robot.tickPeriod();
  nextPulse_ = begin + robot.period() + kToPulse;
}

// The new firmware object has the same address as the old object. All references to the robot
// therefore stay valid.
void HostSimulation::reset(ResetCause cause) {
  const host::HostFirmware::Retained retained = robot.retained();
  edges_.clear();
  std::destroy_at(&binding_);
  std::destroy_at(&robot);
  std::construct_at(&robot, time, pcPort_, StartRecord{.cause = cause}, equipment_, retained);
  std::construct_at(&binding_, robot.pins(), physics);
  observeThreads();
  robot.start();
  beginPeriods();
}

void HostSimulation::runUntil(Instant instant) {
  if (equipment_ != host::HostEquipment::MainControl) {
    runWhole(instant);
  } else {
    runMainControl(instant);
  }
  advanceTo(instant);
}

void HostSimulation::runMainControl(Instant until) {
  while (nextPulse_ <= until) {
    advanceTo(nextPulse_);
    pulse();
  }
}

void HostSimulation::runWhole(Instant until) {
  while (nextPulse_ <= until) {
    pass(nextPulse_);
    pulse();
  }
  pass(until);
}

void HostSimulation::pass(Instant until) {
  while (std::min(nextStep_, nextTick_) <= until) {
    const Instant next = std::min(nextStep_, nextTick_);
    bringEdges(next + Microseconds(-1));
    advanceTo(next);
    if (next == nextStep_) {
      step();
    }
    if (next == nextTick_) {
      nextTick_ = next + robot.tickPeriod();
      robot.tick();
    }
  }
  bringEdges(until);
  advanceTo(until);
}

void HostSimulation::step() {
  const Instant now = nextStep_;
  nextStep_ = now + kStep;
  binding_.drive();
  for (const plant::HallEdge& edge : physics.step()) {
    host::HostWheelPins& pins = robot.pins().wheels.at(edge.wheel);
    edges_.push_back({at(now, edge.offset), &pins.hall.at(edge.sensor), edge.level});
  }
  for (const plant::RcEdge& edge : remoteControl.step()) {
    host::HostEdgeInput& pin = robot.pins().remoteControl.at(edge.channel);
    edges_.push_back({at(now, edge.offset), &pin, edge.level});
  }
  std::ranges::stable_sort(edges_, {}, &Edge::at);
  binding_.measure();
}

void HostSimulation::pulse() {
  nextPulse_ = time.now() + robot.period();
  robot.clockPulse();
}

void HostSimulation::bringEdges(Instant until) {
  const auto end = std::ranges::upper_bound(edges_, until, {}, &Edge::at);
  for (auto edge = edges_.begin(); edge != end; ++edge) {
    advanceTo(edge->at);
    edge->pin->drive(edge->level);
  }
  edges_.erase(edges_.begin(), end);
}

void HostSimulation::advanceTo(Instant instant) {
  if (instant > time.now()) {
    time.advance(instant - time.now());
  }
}

}  // namespace wr::host_robot
