#include "safety/ProtectiveStop.hpp"

#include <cstddef>
#include <optional>

namespace wr {

ProtectiveStop::ProtectiveStop(OrderStage& wrapped, ContactWatch& emergencyStop,
                               RetainedProtection& memory)
    : OrderStageDecorator(wrapped),
      emergencyStop_(emergencyStop),
      memory_(memory),
      cause_(memory.stored().cause),
      wheel_(memory.stored().wheel) {}

void ProtectiveStop::collect(Measurements& measurements, Outputs& outputs) const {
  OrderStageDecorator::collect(measurements, outputs);
  if (latched()) {
    measurements.protection.inhibit = Inhibit::ProtectiveStop;
    measurements.protection.cause = cause_;
    measurements.protection.wheel = wheel_;
  }
}

void ProtectiveStop::follow(const SetPoints& setPoints, std::uint32_t cycle) {
  if (latched()) {
    wrapped().stand(cycle);
    examineContact();
    return;
  }
  wrapped().follow(setPoints, cycle);
  examine(&setPoints);
  if (latched()) {
    wrapped().stand(cycle);
  }
}

void ProtectiveStop::stand(std::uint32_t cycle) {
  wrapped().stand(cycle);
  examine(nullptr);
}

void ProtectiveStop::recover(std::uint32_t cycle) {
  cause_ = StopCause::None;
  wheel_ = Protection::kNoWheel;
  memory_.save({});
  for (WheelSupervision& wheel : wheels_) {
    wheel.reset();
  }
  wrapped().recover(cycle);
  // The acknowledgement releases only a stop that a report has already shown. If the contact has
  // opened after the last cycle, no report has shown this opening yet. Therefore this opening
  // latches a new stop.
  examineContact();
}

void ProtectiveStop::examine(const SetPoints* followed) {
  examineContact();
  OrderStageDecorator::collect(measurements_, outputs_);
  if (measurements_.steeringState == SteeringState::Fault) {
    latch(StopCause::SteeringFault, Protection::kNoWheel);
  }
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    const StopCause cause =
        wheels_[wheel].examine(measurements_.wheels[wheel], outputs_.tensions[wheel],
                               followed == nullptr ? nullptr : &followed->wheels[wheel]);
    latch(cause, static_cast<std::uint8_t>(wheel));
  }
  compareWheels(measurements_, followed != nullptr);
}

void ProtectiveStop::examineContact() {
  if (emergencyStop_.opened()) {
    latch(StopCause::EmergencyStop, Protection::kNoWheel);
  }
}

void ProtectiveStop::compareWheels(const Measurements& measurements, bool following) {
  if (!following) {
    comparison_.reset();
    return;
  }
  const std::optional<std::uint8_t> behind = comparison_.behind(measurements);
  if (behind) {
    latch(StopCause::NoMotion, *behind);
  }
  const std::optional<std::uint8_t> overloaded = comparison_.overloaded(measurements);
  if (overloaded) {
    latch(StopCause::Overcurrent, *overloaded);
  }
}

void ProtectiveStop::latch(StopCause cause, std::uint8_t wheel) {
  if (!latched() && cause != StopCause::None) {
    cause_ = cause;
    wheel_ = wheel;
    memory_.save({.cause = cause, .wheel = wheel});
  }
}

bool ProtectiveStop::latched() const {
  return cause_ != StopCause::None;
}

}  // namespace wr
