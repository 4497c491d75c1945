#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include "main_control/SpySystem.hpp"
#include "sim/host/HostRobot.hpp"
#include "sim/host/HostSerialPort.hpp"
#include "sim/host/HostTimebase.hpp"
#include "support/PcFrames.hpp"

namespace wr::test {

/// The whole firmware in stepped time, with one control system that notes its orders, and a PC.
class SteppedRobot {
 public:
  SteppedRobot() : robot(time, port) {
    robot.systems().add(system);
    robot.start();
  }

  /// Lets the rest of the period pass, and runs the cycle of the clock pulse at its end.
  void cycle() {
    system.calls.clear();
    time.advance(robot.period() - passed_);
    passed_ = Microseconds(0);
    robot.clockPulse();
    take();
  }

  void cycles(int count) {
    for (int i = 0; i < count; ++i) {
      cycle();
    }
  }

  /// Lets a part of the period pass.
  void wait(Microseconds duration) {
    time.advance(duration);
    passed_ = passed_ + duration;
  }

  void rcOrder(int velocity, int direction) {
    robot.rcVelocity(Velocity(velocity));
    robot.rcDirection(Angle(direction));
  }

  void hello() { port.arrive(pc.hello()); }
  void confirm() { port.arrive(pc.confirm(session.value())); }
  void keepAlive() { port.arrive(pc.keepAlive()); }
  void order(const PcOrder& order) { port.arrive(pc.order(order)); }

  /// Connects the PC. It takes two cycles, of which the second one reports.
  void connect() {
    hello();
    cycle();
    confirm();
    cycle();
  }

  /// The report of the last cycle.
  [[nodiscard]] const PcReport& report() const {
    if (!report_) {
      throw std::runtime_error("the last cycle sent no report");
    }
    return *report_;
  }

  [[nodiscard]] bool reported() const { return report_.has_value(); }

  HostTimebase time;
  HostSerialPort port;
  SpySystem system;
  HostRobot robot;
  PcSender pc;
  std::optional<std::uint8_t> session;
  bool drain = true;  // false: the line takes nothing, and the port fills

 private:
  void take() {
    report_.reset();
    if (!drain) {
      return;
    }
    for (const Bytes& body : bodies(port.takeSent())) {
      if (const auto offered = sessionOf(body)) {
        session = offered;
      } else {
        report_ = reportOf(body);
      }
    }
  }

  Microseconds passed_{0};
  std::optional<PcReport> report_;
};

// Numbers in reports.
inline constexpr int kWorking = 0;
inline constexpr int kWaiting = 1;
inline constexpr int kWaitingN = 2;
inline constexpr int kReconnecting = 3;
inline constexpr int kRc = 0;
inline constexpr int kPc = 1;
inline constexpr int kNobody = 255;

}  // namespace wr::test
