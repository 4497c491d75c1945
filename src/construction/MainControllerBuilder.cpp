#include "construction/MainControllerBuilder.hpp"

#include <utility>

#include "services/SystemConstants.hpp"
#include "services/assertion.hpp"

namespace wr {

MainControllerBuilder::Link::Link(const Devices& devices)
    : handshaking(connected, disconnected),
      disconnected(handshaking),
      connected(handshaking, disconnected),
      connection(devices.pcPort, reader, disconnected, devices.start) {}

MainControllerBuilder::RemoteControl::RemoteControl(const RemoteControlDevices& devices,
                                                    const Timebase& timebase,
                                                    const Timebase& edgeTime)
    : velocityPeriod(velocityInstants),
      velocityWidth(velocityPeriod),
      velocityBuffer(velocityWidth, rcVelocity, devices.velocity),
      velocityPin(devices.velocityPin, readVelocityPin),
      readVelocityPin(velocityBuffer, velocityPin, edgeTime),
      directionPeriod(directionInstants),
      directionWidth(directionPeriod),
      directionBuffer(directionWidth, rcDirection, devices.direction),
      directionPin(devices.directionPin, readDirectionPin),
      readDirectionPin(directionBuffer, directionPin, edgeTime),
      reader(devices.velocity, devices.direction, timebase) {}

MainControllerBuilder::Modes::Modes(Reader& pcReader, Reader& rcReader, PcConnection& connection)
    : basicPc(pcReader),
      basicRc(rcReader),
      pc(basicPc, rc, connection),
      rc(basicRc, pc),
      all{&rc, &pc} {}

MainControllerBuilder::PcMode::PcMode(Reader& pcReader, PcConnection& connection)
    : basicPc(pcReader), pc(basicPc, pc, connection), all{&pc} {}

MainControllerBuilder::States::States()
    : waiting(working, waitingN, SystemConstants::instance().waitingCycles()),
      working(waiting),
      waitingN(working, reconnecting),
      reconnecting(working) {}

MainControllerBuilder::Clock::Clock(PeriodicTimer& timer, MainController& controller)
    : timeOut(controller), firstTimer(timer, timeOut) {}

MainControllerBuilder::MainControllerBuilder(Devices devices) : devices_(std::move(devices)) {}

void MainControllerBuilder::buildConnection() {
  require(!link_, AssertId::PartBuiltTwice);
  link_.emplace(devices_);
}

void MainControllerBuilder::buildRemoteControl() {
  require(devices_.remoteControl.has_value(), AssertId::PartMissing);
  require(!remoteControl_, AssertId::PartBuiltTwice);
  const RemoteControlDevices& devices = *devices_.remoteControl;
  remoteControl_.emplace(devices, devices_.timebase,
                         devices.edgeTime != nullptr ? *devices.edgeTime : devices_.timebase);
  remoteControl_->velocityPin.start();
  remoteControl_->directionPin.start();
}

void MainControllerBuilder::buildModes() {
  require(link_.has_value(), AssertId::PartMissing);
  require(remoteControl_.has_value(), AssertId::PartMissing);
  require(firstMode_ == nullptr, AssertId::PartBuiltTwice);
  modes_.emplace(link_->reader, remoteControl_->reader, link_->connection);
  useModes(modes_->rc, modes_->all);
}

void MainControllerBuilder::buildPcMode() {
  require(link_.has_value(), AssertId::PartMissing);
  require(firstMode_ == nullptr, AssertId::PartBuiltTwice);
  pcMode_.emplace(link_->reader, link_->connection);
  useModes(pcMode_->pc, pcMode_->all);
}

void MainControllerBuilder::useModes(Mode& first, std::span<Mode* const> all) {
  require(firstMode_ == nullptr, AssertId::PartBuiltTwice);
  firstMode_ = &first;
  allModes_ = all;
}

void MainControllerBuilder::buildStates() {
  require(firstState_ == nullptr, AssertId::PartBuiltTwice);
  states_.emplace();
  useStates(states_->working);
}

void MainControllerBuilder::useStates(OperationState& first) {
  require(firstState_ == nullptr, AssertId::PartBuiltTwice);
  firstState_ = &first;
}

void MainControllerBuilder::buildController(ControlSystemPool& systems) {
  require(link_.has_value(), AssertId::PartMissing);
  require(firstMode_ != nullptr, AssertId::PartMissing);
  require(firstState_ != nullptr, AssertId::PartMissing);
  require(!controller_, AssertId::PartBuiltTwice);
  controller_.emplace(MainController::Parts{.thread = devices_.thread,
                                            .timebase = devices_.timebase,
                                            .data = data_,
                                            .systems = systems,
                                            .connection = link_->connection,
                                            .watchdog = devices_.watchdog,
                                            .initialState = *firstState_,
                                            .initialMode = *firstMode_,
                                            .modes = allModes_});
}

void MainControllerBuilder::buildClock() {
  require(!clock_, AssertId::PartBuiltTwice);
  clock_.emplace(devices_.cycleTimer, controller());
}

void MainControllerBuilder::start() {
  controller().start();
  clock().start();
}

MainController& MainControllerBuilder::controller() {
  require(controller_.has_value(), AssertId::PartMissing);
  return *controller_;
}

FirstTimer& MainControllerBuilder::clock() {
  require(clock_.has_value(), AssertId::PartMissing);
  return clock_->firstTimer;
}

Reader& MainControllerBuilder::pcReader() {
  require(link_.has_value(), AssertId::PartMissing);
  return link_->reader;
}

Reader& MainControllerBuilder::rcReader() {
  require(remoteControl_.has_value(), AssertId::PartMissing);
  return remoteControl_->reader;
}

PcConnection& MainControllerBuilder::connection() {
  require(link_.has_value(), AssertId::PartMissing);
  return link_->connection;
}

RcPin& MainControllerBuilder::velocityPin() {
  require(remoteControl_.has_value(), AssertId::PartMissing);
  return remoteControl_->velocityPin;
}

RcPin& MainControllerBuilder::directionPin() {
  require(remoteControl_.has_value(), AssertId::PartMissing);
  return remoteControl_->directionPin;
}

}  // namespace wr
