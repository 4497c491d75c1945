#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "services/SystemConstants.hpp"
#include "sim/scenario/PcFrames.hpp"
#include "sim/scenario/RobotSession.hpp"

namespace wr::test {

using std::chrono::microseconds;

/// Switches a new robot on. Returns when the robot reads its serial line. The linker selects the
/// target on which the robot runs: the host or the virtual K64.
[[nodiscard]] std::unique_ptr<scenario::RobotSession> switchOn();

/// Returns the number of random sequences on this target. With these sequences, the robot is
/// compared with the reference.
[[nodiscard]] int referenceSequences();

// Numbers in reports.
inline constexpr int kWorking = 0;
inline constexpr int kWaiting = 1;
inline constexpr int kWaitingN = 2;
inline constexpr int kReconnecting = 3;
inline constexpr int kRc = 0;
inline constexpr int kPc = 1;
inline constexpr int kNobody = 255;
inline constexpr int kNotArmed = 3;

/// The whole firmware, and a PC on its serial line. The test advances the time step by step.
class SteppedRobot {
 public:
  SteppedRobot() : SteppedRobot(switchOn()) {}
  explicit SteppedRobot(std::unique_ptr<scenario::RobotSession> line) : line_(std::move(line)) {}
  SteppedRobot(const SteppedRobot&) = delete;
  SteppedRobot& operator=(const SteppedRobot&) = delete;
  virtual ~SteppedRobot() = default;

  /// Advances the time to the end of the period, and runs the cycle of the clock pulse at this
  /// time.
  virtual void cycle() {
    require(line_->runThroughPulse());
    take();
  }

  void cycles(int count) {
    for (int i = 0; i < count; ++i) {
      cycle();
    }
  }

  /// Advances the time by a part of the period.
  void wait(microseconds duration) { require(line_->runUntil(line_->now() + duration)); }

  /// Returns the simulated mechanics of the robot, with its true values, its ground and its faults.
  [[nodiscard]] plant::Robot& physics() { return line_->robot(); }

  void arrive(std::span<const std::uint8_t> bytes) { line_->send(bytes); }
  void arriveBeforePulse(std::span<const std::uint8_t> bytes, microseconds before) {
    line_->sendBeforePulse(bytes, before);
  }

  void hello() { arrive(pc.hello()); }
  void confirm() { arrive(pc.confirm(welcome.value().session)); }
  void keepAlive() { arrive(pc.keepAlive()); }
  void order(const scenario::PcOrder& order) { arrive(pc.order(order)); }

  /// Connects the PC. This takes two cycles. The second cycle sends a report.
  void connect() {
    hello();
    cycle();
    confirm();
    cycle();
  }

  /// Connects the PC. Then sends orders until the robot follows them. If the robot is not armed, it
  /// first gets neutral orders.
  void commandByPc(const scenario::PcOrder& first = {.id = 1}) {
    connect();
    for (int i = 0; i < kMostTries && !worksForPc(); ++i) {
      order(first);
      cycle();
    }
    if (!worksForPc()) {
      throw std::runtime_error("the robot does not read the orders of the PC");
    }
    if (waitsForArming()) {
      arm();
      order(first);
      cycle();
    }
  }

  /// Sends neutral orders of the PC until the robot is armed. A robot without safety functions does
  /// not wait for neutral orders.
  void arm() {
    for (int i = 0; i < kMostNeutral && waitsForArming(); ++i) {
      order({.id = report().orderId});
      cycle();
    }
    if (waitsForArming()) {
      throw std::runtime_error("neutral orders do not arm the robot");
    }
  }

  /// Runs a cycle in which the PC sends a KeepAlive and no order.
  void silentCycle() {
    keepAlive();
    cycle();
  }

  void silentCycles(int count) {
    for (int i = 0; i < count; ++i) {
      silentCycle();
    }
  }

  /// Returns the report of the last cycle.
  [[nodiscard]] const scenario::PcReport& report() const {
    if (!report_) {
      throw std::runtime_error("the last cycle sent no report");
    }
    return *report_;
  }

  [[nodiscard]] bool reported() const { return report_.has_value(); }

  scenario::PcSender pc;
  std::optional<scenario::PcWelcome> welcome;  // the last Welcome

 private:
  static constexpr int kMostTries = SystemConstants::instance().waitingCycles() + 4;
  static constexpr int kMostNeutral = 12;

  [[nodiscard]] bool waitsForArming() const { return report().inhibit == kNotArmed; }

  [[nodiscard]] bool worksForPc() const {
    return report().mode == kPc && report().state == kWorking && report().orderRead();
  }

  void require(bool running) const {
    if (!running) {
      throw std::runtime_error("finding: " + line_->finding().value().text);
    }
  }

  void take() {
    report_.reset();
    for (const scenario::Bytes& body : scenario::bodies(line_->takeSent())) {
      if (const auto answer = scenario::welcomeOf(body)) {
        welcome = answer;
      } else {
        report_ = scenario::reportOf(body);
      }
    }
  }

  std::unique_ptr<scenario::RobotSession> line_;
  std::optional<scenario::PcReport> report_;
};

}  // namespace wr::test
