#pragma once

#include <algorithm>
#include <chrono>
#include <utility>
#include <vector>

#include "sim/host/HostPins.hpp"
#include "sim/host/HostScheduler.hpp"
#include "sim/host/HostSerialPort.hpp"
#include "sim/host/HostThread.hpp"
#include "sim/host/HostTimebase.hpp"
#include "sim/host/HostTimer.hpp"
#include "sim/host/HostWatchdog.hpp"
#include "sim/host_robot/HostWires.hpp"
#include "sim/plant/RemoteControl.hpp"
#include "sim/plant/Robot.hpp"
#include "sim/scenario/RobotSession.hpp"
#include "usual_design/Devices.hpp"

namespace wr::test {

/// A design of Main Control and one wheel on the host, connected to the simulated robot. The caller
/// advances the time step by step. The other wheels have no firmware. Therefore they coast.
/// @tparam Design the design
template <class Design>
class OneWheelLine final : public scenario::RobotSession {
 public:
  /// Constructs and starts the design.
  /// @param more further devices, for a design that needs more devices
  template <class... More>
  explicit OneWheelLine(More&... more)
      : pins(scheduler_), physics_(kSeed), binding_(pins, physics_), design_(devices(), more...) {
    port.setClock(time);
    [[maybe_unused]] const auto setClockOf = [this](auto& device) {
      if constexpr (requires { device.setClock(time); }) {
        device.setClock(time);
      }
    };
    (setClockOf(more), ...);
    binding_.measure();
    cycleTimer_.connect([this] { design_.cycleTimerExpired(); });
    tickTimer_.connect([this] { design_.tickTimerExpired(); });
    for (host::HostEdgeInput& hall : pins.wheels[0].hall) {
      hall.connect([this] { design_.hallEdge(); });
    }
    for (host::HostEdgeInput& signal : pins.remoteControl) {
      signal.connect([this] { design_.remoteControlEdge(); });
    }
    design_.start();
  }

  void send(std::span<const std::uint8_t> bytes) override { port.arrive(bytes); }

  void sendBeforePulse(std::span<const std::uint8_t> bytes, Time before) override {
    runUntil(nextPulse() - before);
    send(bytes);
  }

  [[nodiscard]] std::vector<std::uint8_t> takeSent() override { return port.takeSent(); }

  bool runUntil(Time instant) override {
    while (nextStep_ <= instant) {
      step();
    }
    advanceTo(instant);
    return true;
  }

  bool runThroughPulse() override { return runUntil(nextPulse()); }

  [[nodiscard]] Time now() const override { return Time(time.now().sinceStart()); }
  [[nodiscard]] plant::Robot& robot() override { return physics_; }
  [[nodiscard]] plant::RemoteControl& remoteControl() override { return remoteControl_; }
  [[nodiscard]] std::optional<scenario::SessionFinding> finding() const override {
    return std::nullopt;
  }

  host::HostTimebase time;
  host::HostSerialPort port;

 private:
  static constexpr std::uint32_t kSeed = 1;
  static constexpr Time kStep = plant::Robot::kStep;

  struct Edge {
    Time at;
    host::HostEdgeInput* pin;
    bool level;
  };

  [[nodiscard]] Devices devices() {
    host::HostWheelPins& wheel = pins.wheels[0];
    return {.pwm = wheel.pwm,
            .orientation = wheel.orientation,
            .enable = wheel.enable,
            .hallA = wheel.hall[0],
            .hallB = wheel.hall[1],
            .current = wheel.current,
            .rcVelocity = pins.remoteControl[0],
            .rcDirection = pins.remoteControl[1],
            .pcPort = port,
            .cycleTimer = cycleTimer_,
            .tickTimer = tickTimer_,
            .timebase = time,
            .watchdog = watchdog,
            .start = start_,
            .mainThread = mainThread_,
            .wheelThread = wheelThread_};
  }

  [[nodiscard]] Time nextPulse() const { return nextPulse_; }

  // Runs 1 ms: first the tick, then the clock pulse if it is due, and then the edges of this ms.
  void step() {
    advanceTo(nextStep_);
    tickTimer_.periodPassed();
    if (nextStep_ == nextPulse_) {
      nextPulse_ += Time(cycleTimer_.period().count());
      cycleTimer_.periodPassed();
    }
    design_.run();
    binding_.drive();
    std::vector<Edge> edges;
    for (const plant::HallEdge& edge : physics_.step()) {
      edges.push_back(
          {at(edge.offset), &pins.wheels.at(edge.wheel).hall.at(edge.sensor), edge.level});
    }
    for (const plant::RcEdge& edge : remoteControl_.step()) {
      edges.push_back({at(edge.offset), &pins.remoteControl.at(edge.channel), edge.level});
    }
    std::ranges::stable_sort(edges, {}, &Edge::at);
    for (const Edge& edge : edges) {
      advanceTo(edge.at);
      edge.pin->drive(edge.level);
    }
    binding_.measure();
    nextStep_ += kStep;
  }

  // Returns the time of an edge in this step, in whole microseconds.
  [[nodiscard]] Time at(std::chrono::nanoseconds offset) const {
    return std::min(nextStep_ + std::chrono::duration_cast<Time>(offset),
                    nextStep_ + kStep - Time(1));
  }

  void advanceTo(Time instant) {
    if (instant > now()) {
      time.advance(Microseconds((instant - now()).count()));
    }
  }

  host::HostScheduler scheduler_;

 public:
  host::HostPins pins;
  host::HostWatchdog watchdog{time};

 private:
  host::HostThread mainThread_{scheduler_, 1};
  host::HostThread wheelThread_{scheduler_, 2};
  host::HostTimer cycleTimer_{scheduler_};
  host::HostTimer tickTimer_{scheduler_};
  StartRecord start_{.cause = ResetCause::Pin};
  plant::Robot physics_;
  plant::RemoteControl remoteControl_;
  host_robot::HostWires binding_;
  Design design_;
  Time nextStep_ = kStep;
  Time nextPulse_{SystemConstants::instance().cyclePeriod().count()};
};

}  // namespace wr::test
