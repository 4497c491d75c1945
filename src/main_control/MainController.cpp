#include "main_control/MainController.hpp"

#include <optional>

#include "communication/serialization/ReportMessage.hpp"

namespace wr {

MainController::Body::Body(MainController& mCtrl) : mCtrl_(mCtrl) {}

void MainController::Body::execute() {
  mCtrl_.cycle();
}

MainController::MainController(const Parts& parts)
    : body_(*this),
      thread_(parts.thread),
      timebase_(parts.timebase),
      data_(parts.data),
      systems_(parts.systems),
      connection_(parts.connection),
      watchdog_(parts.watchdog),
      opSt_(parts.initialState),
      mode_(parts.initialMode),
      modes_(parts.modes) {}

void MainController::start() {
  thread_.start(body_);
}

void MainController::clockPulse() {
  pulses_.write(timebase_.awakeCycles(), timebase_.now());
  thread_.post();
}

void MainController::cycle() {
  const Stamped<std::uint32_t> pulse = *pulses_.read();
  data_.beginCycle(pulse.at);
  data_.saveStart(pulse.value, timebase_.awakeCycles());
  connection_.beginCycle(pulse.at);
  serveSources();
  noteStop();
  read();
  control();
  write();
  if (systems_.completed(data_.cycle())) {
    watchdog_.refresh();
  }
}

void MainController::read() {
  opSt_.get().read(*this);
}

void MainController::control() {
  opSt_.get().control(*this);
}

void MainController::write() {
  opSt_.get().write(*this);
}

void MainController::changeOpState(OperationState& state) {
  opSt_ = state;
}

void MainController::changeMode(Mode& mode) {
  mode_ = mode;
}

Mode& MainController::getMode() {
  return mode_;
}

ControlData& MainController::getData() {
  return data_;
}

void MainController::applyControl() {
  const std::optional<SetPoints>& setPoints = data_.setPoints();
  const bool stopped = data_.stopped();
  if (stopped || !setPoints) {
    holdSystems();
  } else if (setPoints->acknowledge) {
    // A waiting cycle does not repeat the acknowledgement. A repeated acknowledgement would also
    // release a fault that occurred after the order.
    if (setPoints->neutral() && !setPoints->repeated) {
      systems_.acknowledge(data_.cycle());
      data_.saveHeld(true);
    } else {
      holdSystems();
    }
  } else {
    systems_.control(*setPoints, data_.cycle());
    data_.saveHeld(false);
  }
}

void MainController::holdSystems() {
  systems_.hold(data_.cycle());
  data_.saveHeld(true);
}

void MainController::sendReport(OperationStateId state) {
  noteOverrun();
  systems_.collect(data_.measurements(), data_.outputs());
  const ReportMessage report(data_.report(state, mode_.get().id(), connection_.counts()));
  connection_.sendReport(report);
  data_.saveReported(timebase_.awakeCycles());
}

void MainController::serveSources() {
  // bound: readingModes
  for (Mode* mode : modes_) {
    mode->serve();
  }
}

void MainController::noteStop() {
  std::uint32_t sources = 0;
  // bound: readingModes
  for (const Mode* mode : modes_) {
    const std::uint32_t bit = 1U << static_cast<std::uint32_t>(mode->id());
    sources |= mode->stopOrdered() ? bit : 0;
  }
  data_.saveStop(static_cast<std::uint8_t>(sources));
}

void MainController::noteOverrun() {
  const std::uint32_t overruns = thread_.overruns();
  if (overruns != seenOverruns_ || !systems_.completed(data_.cycle())) {
    data_.saveOverrun();
  }
  seenOverruns_ = overruns;
}

}  // namespace wr
