#pragma once

#include <memory>

#include "main_control/SpySystem.hpp"
#include "sim/host_robot/HostSession.hpp"
#include "system/SteppedRobot.hpp"

namespace wr::test {

/// The robot on the host. A test also has access to the remote control, the scheduler, and one
/// control system that records its orders.
class HostSteppedRobot : public SteppedRobot {
 public:
  explicit HostSteppedRobot(host::HostEquipment equipment = host::HostEquipment::Whole)
      : HostSteppedRobot(std::make_unique<host_robot::HostSession>(equipment)) {}

  void cycle() override {
    system.calls.clear();
    SteppedRobot::cycle();
  }

  /// Runs a cycle while the serial line accepts no bytes. The sent bytes then fill the send buffer
  /// of the port.
  void cycleWithoutLine() { host_.runThroughPulse(); }

  /// Returns the time until the next clock pulse. The first clock pulse is more than a period after
  /// the start.
  [[nodiscard]] microseconds untilPulse() const {
    return microseconds((host_.world.nextPulse() - time.now()).count());
  }

  void rcOrder(int velocity, int direction) {
    robot.rcVelocity(Velocity(velocity));
    robot.rcDirection(Angle(direction));
  }

 private:
  explicit HostSteppedRobot(std::unique_ptr<host_robot::HostSession> line)
      : HostSteppedRobot(*line, line) {}

  HostSteppedRobot(host_robot::HostSession& host, std::unique_ptr<host_robot::HostSession>& line)
      : SteppedRobot(std::move(line)),
        host_(host),
        time(host.world.time),
        port(host.port),
        robot(host.world.robot) {
    robot.systems().add(system);
    host.start();
  }

  host_robot::HostSession& host_;

 public:
  host::HostTimebase& time;
  host::HostSerialPort& port;
  host::HostFirmware& robot;
  SpySystem system;
};

}  // namespace wr::test
