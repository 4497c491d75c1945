#include "construction/MainControllerBuilder.hpp"

#include "services/assertion.hpp"

namespace wr {

MainControllerBuilder::Readers::Readers(const Devices& devices)
    : pc(devices.timebase), rc(devices.rcVelocity, devices.rcDirection, devices.timebase) {}

MainControllerBuilder::Link::Link(const Devices& devices, SerialReader& reader)
    : handshaking(connected, disconnected),
      disconnected(handshaking),
      connected(handshaking, disconnected),
      connection(devices.pcPort, devices.timebase, reader, disconnected, devices.start) {}

MainControllerBuilder::Modes::Modes(Readers& readers, const PcConnection& connection)
    : basicPc(readers.pc),
      basicRc(readers.rc),
      pc(basicPc, rc, connection),
      rc(basicRc, pc),
      all{&rc, &pc} {}

MainControllerBuilder::States::States()
    : waiting(working, waitingN),
      working(waiting),
      waitingN(working, reconnecting),
      reconnecting(working) {}

MainControllerBuilder::Clock::Clock(PeriodicTimer& timer, MainController& controller)
    : timeOut(controller), firstTimer(timer, timeOut) {}

MainControllerBuilder::MainControllerBuilder(const Devices& devices) : devices_(devices) {}

void MainControllerBuilder::buildReaders() {
  readers_.emplace(devices_);
}

void MainControllerBuilder::buildConnection() {
  require(readers_.has_value(), AssertId::PartMissing);
  link_.emplace(devices_, readers_->pc);
}

void MainControllerBuilder::buildModes() {
  require(readers_.has_value(), AssertId::PartMissing);
  require(link_.has_value(), AssertId::PartMissing);
  modes_.emplace(*readers_, link_->connection);
}

void MainControllerBuilder::buildStates() {
  states_.emplace();
}

void MainControllerBuilder::buildController(ControlSystemPool& systems) {
  require(link_.has_value(), AssertId::PartMissing);
  require(modes_.has_value(), AssertId::PartMissing);
  require(states_.has_value(), AssertId::PartMissing);
  controller_.emplace(MainController::Parts{.thread = devices_.thread,
                                            .timebase = devices_.timebase,
                                            .data = data_,
                                            .systems = systems,
                                            .connection = link_->connection,
                                            .watchdog = devices_.watchdog,
                                            .initialState = states_->working,
                                            .initialMode = modes_->rc,
                                            .modes = modes_->all});
}

void MainControllerBuilder::buildClock() {
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

}  // namespace wr
