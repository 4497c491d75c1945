// Fuzzes the whole firmware with its safety functions, in the simulated robot. The input selects
// events and their times. The events are bytes of the PC, changes of the remote control, extra
// edges of Hall sensors, faults of sensors and leads, the emergency stop, changes of the slope, and
// resets.

#include <fuzzer/FuzzedDataProvider.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include "fuzz/LinkOracle.hpp"
#include "fuzz/PcLine.hpp"
#include "fuzz/expect.hpp"
#include "sim/host_robot/HostSession.hpp"
#include "sim/scenario/PcFrames.hpp"

namespace wr::fuzz {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

constexpr int kMostCycles = 120;           // maximum number of cycles of a run
constexpr int kRecoveryCycles = 10;        // one second
constexpr int kMostBetween = 4;            // maximum number of events in a cycle
constexpr int kMostStopped = 12;           // cycles from a stop until every voltage is 0
constexpr std::size_t kMostUnread = 1500;  // capacity of the port's storage [byte]

class FuzzedRobot {
 public:
  FuzzedRobot() { session_.start(); }

  // Executes one event that happens to the robot, for example a fault of a sensor. The input
  // selects the event.
  void event(FuzzedDataProvider& input) {
    switch (input.ConsumeIntegralInRange(0, 9)) {
      case 0:
        remoteControl(input);
        break;
      case 1:
        hallEdge(input);
        break;
      case 2:
        fault(input);
        break;
      case 3:
        session_.robot().setEmergencyStop(input.ConsumeIntegralInRange(0, 3) == 0
                                              ? plant::EmergencyStop::Brake
                                              : plant::EmergencyStop::Released);
        break;
      case 4:
        if (input.ConsumeIntegralInRange(0, 3) == 0) {
          reset(input.ConsumeBool());
        }
        break;
      case 5:
        session_.robot().setSlope(input.ConsumeIntegralInRange(-15, 15));
        break;
      default:
        send(pc.next(input));
    }
  }

  void send(const test::Bytes& bytes) {
    if (unread_.size() + bytes.size() > kMostUnread) {
      return;
    }
    session_.send(bytes);
    for (const std::uint8_t byte : bytes) {
      unread_.push_back({byte, nowUs()});
    }
  }

  void wait(milliseconds duration) { session_.runUntil(session_.now() + duration); }

  // Advances the time to the next cycle, runs the cycle, and checks the invariants of each cycle.
  void cycle() {
    session_.runThroughPulse();
    for (const Received& one : unread_) {
      oracle_.receive(one.byte, one.at);
    }
    unread_.clear();
    oracle_.endService(nowUs());
    oracle_.serviceEnded();
    takeSent();
    checkStop();
    checkMotion();
    expect(!session_.world.robot.watchdog().missed(), "the watchdog is refreshed in time");
  }

  void repair() {
    for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
      for (const plant::Fault fault : kFaults) {
        session_.robot().setFault(fault, wheel, false);
      }
    }
    session_.robot().setEmergencyStop(plant::EmergencyStop::Released);
    session_.robot().setSlope(0);
    session_.remoteControl().set(std::nullopt);
  }

  [[nodiscard]] bool reported() const { return report_.has_value(); }
  [[nodiscard]] bool welcomed() const { return welcomed_; }
  void forgetWelcome() { welcomed_ = false; }

  PcLine pc;

 private:
  struct Received {
    std::uint8_t byte;
    LinkOracle::Time at;
  };

  static constexpr std::array kFaults{plant::Fault::Hall,    plant::Fault::HallA,
                                      plant::Fault::HallB,   plant::Fault::Leads,
                                      plant::Fault::Current, plant::Fault::CurrentStuck,
                                      plant::Fault::Angle,   plant::Fault::HallSwapped};

  [[nodiscard]] LinkOracle::Time nowUs() const {
    return std::chrono::duration_cast<microseconds>(session_.now()).count();
  }

  void remoteControl(FuzzedDataProvider& input) {
    plant::RemoteControl& remote = session_.remoteControl();
    if (input.ConsumeIntegralInRange(0, 3) == 0) {
      remote.set(std::nullopt);
      return;
    }
    const bool centred = input.ConsumeBool();
    const auto stick = [&input] { return input.ConsumeIntegralInRange(-100, 100) / 100.0; };
    remote.set(plant::Sticks{centred ? 0.0 : stick(), stick()});
    constexpr std::array kPositions{plant::EnablePosition::Stop, plant::EnablePosition::Pc,
                                    plant::EnablePosition::Drive};
    remote.setEnable(input.PickValueInArray(kPositions));
    remote.setNoise(false);
  }

  void hallEdge(FuzzedDataProvider& input) {
    host::HostEdgeInput& pin =
        session_.world.robot.pins()
            .wheels.at(input.ConsumeIntegralInRange<std::size_t>(0, kWheelCount - 1))
            .hall.at(input.ConsumeIntegralInRange<std::size_t>(0, 1));
    pin.drive(!pin.level());
  }

  void fault(FuzzedDataProvider& input) {
    const auto wheel = input.ConsumeIntegralInRange<std::size_t>(0, kWheelCount - 1);
    const bool present = input.ConsumeIntegralInRange(0, 2) == 0;
    const plant::Fault kind = input.PickValueInArray(kFaults);
    session_.robot().setFault(kind, wheel, present);
  }

  // Resets the robot. A reset loses the bytes that the firmware has not read. If a stop of the PC
  // or a protective stop is in force, it must still be in force after a reset by the reset pin.
  void reset(bool power) {
    session_.reset(power ? scenario::ResetKind::Power : scenario::ResetKind::Pin);
    stopBefore_ = !power && (stopBefore_ || oracle_.stop());
    protectedBefore_ = !power && latched();
    unread_.clear();
    oracle_ = LinkOracle();
    report_.reset();
    voltages_ = {};
    armedBefore_ = false;
    stopped_ = 0;
    resetNow_ = true;
  }

  void takeSent() {
    report_.reset();
    for (const scenario::Bytes& body : scenario::bodies(session_.takeSent())) {
      if (const auto welcome = scenario::welcomeOf(body)) {
        pc.session = welcome->session;
        welcomed_ = true;
        oracle_.welcomeSent(welcome->session, nowUs());
      } else {
        report_ = scenario::reportOf(body);
        expect(report_.has_value(), "each frame is a Welcome or a Report");
        checkRanges();
      }
    }
  }

  void checkRanges() const {
    expect(report_->state <= 3 && report_->mode <= 1,
           "the numbers of the state and the mode are defined");
    expect(report_->source <= 1 || report_->source == 255, "the number of the source is defined");
    expect(report_->inhibit <= 4 && report_->stopCause <= 11,
           "the numbers of the reason and the cause are defined");
    expect(std::abs(report_->steeringSetPoint) <= 3200, "the steering set-point is in range");
    expect(report_->turn >= -1 && report_->turn <= 1, "the turn direction is -1, 0 or 1");
  }

  [[nodiscard]] ControlData& data() { return session_.world.robot.controller().getData(); }
  [[nodiscard]] const Protection& protection() { return data().measurements().protection; }
  [[nodiscard]] bool latched() { return protection().inhibit == Inhibit::ProtectiveStop; }

  // Checks the stop order of the PC. If the protocol accepts this order, the robot must stop in the
  // cycle that reads the order. Also checks that this stop and a protective stop remain in force
  // after a reset.
  void checkStop() {
    expect(!oracle_.stop() || data().stopped(),
           "a stop order of the PC stops the robot in the same cycle");
    if (data().setPoints() && data().setPoints()->neutral()) {
      stopBefore_ = false;
    }
    expect(!stopBefore_ || data().stopped(), "a stop order of the PC stays in force after a reset");
    if (resetNow_ && protectedBefore_) {
      expect(latched() || data().stopped(), "a protective stop stays in force after a reset");
    }
    resetNow_ = false;
  }

  // Checks that no voltage rises while the robot is stopped or not armed.
  void checkMotion() {
    const bool free = armedBefore_ && !data().stopped() && !latched();
    bool voltage = false;
    for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
      const host::HostWheelPins& pins = session_.world.robot.pins().wheels.at(wheel);
      const int duty = pins.enable.isOn() ? pins.pwm.dutyCycle().count() : 0;
      expect(duty >= 0 && duty <= 10'000, "the duty cycle is in range");
      expect(free || duty <= voltages_.at(wheel),
             "no voltage rises while the robot is stopped or not armed");
      voltages_.at(wheel) = duty;
      voltage = voltage || duty > 0;
    }
    stopped_ = data().stopped() || latched() ? stopped_ + 1 : 0;
    expect(!voltage || stopped_ < kMostStopped, "a stop lowers every voltage to 0");
    armedBefore_ = protection().armed;
  }

  host_robot::HostSession session_{host::HostEquipment::Safe};
  LinkOracle oracle_;
  std::vector<Received> unread_;
  std::optional<scenario::PcReport> report_;
  std::array<int, kWheelCount> voltages_{};
  bool welcomed_ = false;
  bool armedBefore_ = false;
  bool stopBefore_ = false;
  bool protectedBefore_ = false;
  bool resetNow_ = false;
  int stopped_ = 0;  // number of successive cycles with a stop
};

void connect(FuzzedRobot& robot) {
  robot.forgetWelcome();
  robot.send({0});
  for (int i = 0; i < kRecoveryCycles && !robot.reported(); ++i) {
    robot.send(robot.welcomed() ? robot.pc.good(kConfirm, {robot.pc.session})
                                : robot.pc.good(kHello));
    robot.cycle();
  }
  expect(robot.reported(), "one second of valid frames connects the PC");
}

void fuzz(FuzzedDataProvider& input) {
  FuzzedRobot robot;
  // For most inputs, the run begins with a robot that is connected and able to drive.
  if (input.ConsumeIntegralInRange(0, 3) > 0) {
    connect(robot);
    for (int i = 0; i < 16; ++i) {
      robot.send(robot.pc.drive(0));
      robot.cycle();
    }
  }
  for (int i = 0; i < kMostCycles && input.remaining_bytes() > 0; ++i) {
    const int events = input.ConsumeIntegralInRange(0, kMostBetween);
    for (int event = 0; event < events; ++event) {
      robot.wait(milliseconds(input.ConsumeIntegralInRange(0, 20)));
      robot.event(input);
    }
    robot.cycle();
  }
  robot.repair();
  robot.cycle();
  connect(robot);
}

}  // namespace
}  // namespace wr::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider input(data, size);
  wr::fuzz::fuzz(input);
  return 0;
}
