#include "main_control/ControlData.hpp"

#include <limits>

namespace wr {

void ControlData::beginCycle(Instant clockPulse) {
  ++cycle_;
  clockPulse_ = clockPulse;
  stopSources_ = 0;
  orderRead_ = false;
  held_ = false;
  overran_ = false;
  measurements_ = {};
  outputs_ = {};
  if (setPoints_) {
    setPoints_->repeated = true;
  }
}

void ControlData::saveStart(std::uint32_t pulse, std::uint32_t start) {
  costs_ = {.report = reported_, .awake = pulse - pulse_.value_or(pulse), .start = start - pulse};
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
  source_ = readSource_;
  orderRead_ = true;
}

void ControlData::saveStop(std::uint8_t sources) {
  stopSources_ = sources;
}

void ControlData::saveHeld(bool held) {
  held_ = held;
}

void ControlData::saveOverrun() {
  overran_ = true;
  if (overruns_ < std::numeric_limits<std::uint16_t>::max()) {
    ++overruns_;
  }
}

const std::optional<SetPoints>& ControlData::setPoints() const {
  return setPoints_;
}

bool ControlData::stopped() const {
  return stopSources_ != 0;
}

std::uint32_t ControlData::cycle() const {
  return cycle_;
}

Measurements& ControlData::measurements() {
  return measurements_;
}

Outputs& ControlData::outputs() {
  return outputs_;
}

ReportData ControlData::report(OperationStateId state, ModeId mode,
                               const LinkCounts& counts) const {
  const Inhibit why = inhibit(state);
  ReportData data{.cycle = cycle_,
                  .time = clockPulse_,
                  .operationState = static_cast<std::uint8_t>(state),
                  .readingMode = static_cast<std::uint8_t>(mode),
                  .source = static_cast<std::uint8_t>(source_),
                  .stopSources = stopSources_,
                  .orderRead = orderRead_,
                  .held = held_ || why != Inhibit::None,
                  .overran = overran_,
                  .setPoints = setPoints_.value_or(SetPoints{}),
                  .measurements = measurements_,
                  .outputs = outputs_,
                  .overruns = overruns_,
                  .link = counts,
                  .costs = costs_};
  data.measurements.protection.inhibit = why;
  return data;
}

Inhibit ControlData::inhibit(OperationStateId state) const {
  if (stopped()) {
    return Inhibit::Stop;
  }
  if (!setPoints_ || state == OperationStateId::Reconnecting) {
    return Inhibit::NoOrder;
  }
  return measurements_.protection.inhibit;
}

}  // namespace wr
