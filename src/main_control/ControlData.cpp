#include "main_control/ControlData.hpp"

#include <limits>

namespace wr {

void ControlData::beginCycle(Instant clockPulse) {
  ++report_.cycle;
  report_.time = clockPulse;
  report_.stopSources = 0;
  report_.orderRead = false;
  report_.held = false;
  report_.overran = false;
  report_.measurements.clear();
  report_.outputs.clear();
  if (setPoints_) {
    setPoints_->repeated = true;
  }
}

void ControlData::saveStart(std::uint32_t pulse, std::uint32_t start) {
  report_.costs = {
      .report = reported_, .awake = pulse - pulse_.value_or(pulse), .start = start - pulse};
  pulse_ = pulse;
  reported_ = 0;
}

void ControlData::saveReported(std::uint32_t end) {
  reported_ = end - pulse_.value_or(end);
}

void ControlData::saveModeId(ModeId source) {
  readSource_ = source;
}

void ControlData::saveSetPoints(const SetPoints& setPoints) {
  setPoints_ = setPoints;
  report_.source = static_cast<std::uint8_t>(readSource_);
  report_.orderRead = true;
}

void ControlData::saveStop(std::uint8_t sources) {
  report_.stopSources = sources;
}

void ControlData::saveHeld(bool held) {
  report_.held = held;
}

void ControlData::saveOverrun() {
  report_.overran = true;
  if (report_.overruns < std::numeric_limits<std::uint16_t>::max()) {
    ++report_.overruns;
  }
}

const std::optional<SetPoints>& ControlData::setPoints() const {
  return setPoints_;
}

bool ControlData::stopped() const {
  return report_.stopSources != 0;
}

std::uint32_t ControlData::cycle() const {
  return report_.cycle;
}

Measurements& ControlData::measurements() {
  return report_.measurements;
}

Outputs& ControlData::outputs() {
  return report_.outputs;
}

const ReportData& ControlData::report(OperationStateId state, ModeId mode,
                                      const LinkCounts& counts) {
  const Inhibit why = inhibit(state);
  report_.operationState = static_cast<std::uint8_t>(state);
  report_.readingMode = static_cast<std::uint8_t>(mode);
  report_.held = report_.held || why != Inhibit::None;
  report_.measurements.protection.inhibit = why;
  report_.link = counts;
  if (setPoints_) {
    report_.setPoints = *setPoints_;
  }
  return report_;
}

Inhibit ControlData::inhibit(OperationStateId state) const {
  if (stopped()) {
    return Inhibit::Stop;
  }
  if (!setPoints_ || state == OperationStateId::Reconnecting) {
    return Inhibit::NoOrder;
  }
  return report_.measurements.protection.inhibit;
}

}  // namespace wr
