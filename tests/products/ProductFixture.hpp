#pragma once

#include <gtest/gtest.h>

#include <array>
#include <optional>

#include "construction/ControlSystemBuilder.hpp"
#include "construction/ControlSystemPoolBuilder.hpp"
#include "construction/MainControllerBuilder.hpp"
#include "main_control/SpySystem.hpp"
#include "sim/host/HostEdgeInput.hpp"
#include "sim/host/HostScheduler.hpp"
#include "sim/host/HostSerialPort.hpp"
#include "sim/host/HostThread.hpp"
#include "sim/host/HostTimebase.hpp"
#include "sim/host/HostTimer.hpp"
#include "sim/host/HostWatchdog.hpp"
#include "sim/scenario/PcFrames.hpp"

namespace wr::test {

/// A builder of a spy control system. The spy records the orders that it receives. A tick of the
/// second timer has no effect on the spy. The builder records whether the spy was built, and
/// whether it was started afterwards.
class SpyBuilder final : public ControlSystemBuilder, public Command {
 public:
  SpySystem spy;
  bool built = false;
  bool started = false;

  void buildActuator() override {}
  void buildSensors() override {}
  void buildController() override {}
  void buildSystem() override { built = true; }
  void start() override { started = built; }
  [[nodiscard]] ControlSystem& system() override { return spy; }
  [[nodiscard]] Command& tickCommand() override { return *this; }
  void execute() override {}
};

/// The builders and the cycles of a robot on the host. Each test adds the director of a robot
/// variant.
class ProductFixture : public testing::Test {
 protected:
  template <class Director>
  void begin(Director& director) {
    port.setClock(time);
    director.construct();
    cycleTimer.connect([this] { builder.clock().expired(); });
    tickTimer.connect([this] { poolBuilder.timer().expired(); });
    director.start();
  }

  // Connects the PC in two cycles.
  void connect() {
    port.arrive(pc.hello());
    cycle();
    port.arrive(pc.confirm(welcome.value().session));
    cycle();
  }

  // Runs a cycle. Returns its report, or a report with default values if the PC is not connected.
  scenario::PcReport cycle() {
    time.advance(milliseconds(100));
    spy.calls.clear();
    cycleTimer.periodPassed();
    scenario::PcReport report;
    for (const scenario::Bytes& body : scenario::bodies(port.takeSent())) {
      if (const auto sent = scenario::reportOf(body)) {
        report = *sent;
      } else {
        welcome = scenario::welcomeOf(body);
      }
    }
    return report;
  }

  // Runs a cycle in which the PC sends a KeepAlive.
  scenario::PcReport cycleWithPc() {
    port.arrive(pc.keepAlive());
    return cycle();
  }

  host::HostTimebase time;
  host::HostSerialPort port;
  host::HostScheduler scheduler;
  host::HostThread thread{scheduler, 1};
  host::HostTimer cycleTimer{scheduler};
  host::HostTimer tickTimer{scheduler};
  host::HostWatchdog watchdog{time};
  StartRecord start;
  host::HostEdgeInput velocityPin{scheduler, false};
  host::HostEdgeInput directionPin{scheduler, false};
  Pipe<Velocity> velocity;
  Pipe<Angle> direction;
  SpyBuilder spyBuilder;
  SpySystem& spy = spyBuilder.spy;
  std::array<ControlSystemBuilder*, 1> builders{&spyBuilder};
  ControlSystemPoolBuilder poolBuilder{tickTimer, builders};
  MainControllerBuilder builder{
      {.thread = thread,
       .cycleTimer = cycleTimer,
       .timebase = time,
       .pcPort = port,
       .watchdog = watchdog,
       .start = start,
       .remoteControl = MainControllerBuilder::RemoteControlDevices{.velocityPin = velocityPin,
                                                                    .directionPin = directionPin,
                                                                    .velocity = velocity,
                                                                    .direction = direction}}};
  scenario::PcSender pc;
  std::optional<scenario::PcWelcome> welcome;
};

}  // namespace wr::test
