#include "safety/Arming.hpp"

#include "services/SystemConstants.hpp"

namespace wr {

namespace {

constexpr Microseconds kNeutral = milliseconds(500);
constexpr auto kNeutralOrders =
    static_cast<std::uint8_t>(kNeutral.count() / SystemConstants::instance().cyclePeriod().count());

}  // namespace

Arming::Arming(OrderStage& wrapped) : OrderStageDecorator(wrapped) {}

void Arming::collect(Measurements& measurements, Outputs& outputs) const {
  OrderStageDecorator::collect(measurements, outputs);
  Protection& protection = measurements.protection;
  protection.armed = armed() && protection.inhibit == Inhibit::None;
  if (!armed() && protection.inhibit == Inhibit::None) {
    protection.inhibit = Inhibit::NotArmed;
  }
}

void Arming::follow(const SetPoints& setPoints, std::uint32_t cycle) {
  if (armed()) {
    wrapped().follow(setPoints, cycle);
    return;
  }
  if (!setPoints.repeated) {
    neutralOrders_ = setPoints.neutral() ? static_cast<std::uint8_t>(neutralOrders_ + 1) : 0;
  }
  wrapped().stand(cycle);
}

void Arming::stand(std::uint32_t cycle) {
  disarm();
  wrapped().stand(cycle);
}

void Arming::recover(std::uint32_t cycle) {
  disarm();
  wrapped().recover(cycle);
}

void Arming::disarm() {
  neutralOrders_ = 0;
}

bool Arming::armed() const {
  return neutralOrders_ >= kNeutralOrders;
}

}  // namespace wr
