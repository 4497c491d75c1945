#include "construction/ControlSystemPoolBuilder.hpp"

#include "services/assertion.hpp"

namespace wr {

ControlSystemPoolBuilder::ControlSystemPoolBuilder(PeriodicTimer& tickTimer,
                                                   std::span<ControlSystemBuilder* const> builders)
    : tickTimer_(tickTimer), builders_(builders) {}

void ControlSystemPoolBuilder::buildSystems() {
  for (ControlSystemBuilder* builder : builders_) {
    builder->buildActuator();
    builder->buildSensors();
    builder->buildController();
    builder->buildSystem();
  }
}

void ControlSystemPoolBuilder::buildPool() {
  require(!pool_, AssertId::PartBuiltTwice);
  pool_.emplace();
  for (ControlSystemBuilder* builder : builders_) {
    pool_->add(builder->system());
  }
}

void ControlSystemPoolBuilder::buildTimer() {
  require(!timer_, AssertId::PartBuiltTwice);
  timer_.emplace(tickTimer_);
  for (ControlSystemBuilder* builder : builders_) {
    timer_->add(builder->tickCommand());
  }
}

void ControlSystemPoolBuilder::start() {
  for (ControlSystemBuilder* builder : builders_) {
    builder->start();
  }
  timer().start();
}

ControlSystemPool& ControlSystemPoolBuilder::pool() {
  require(pool_.has_value(), AssertId::PartMissing);
  return *pool_;
}

SecondTimer& ControlSystemPoolBuilder::timer() {
  require(timer_.has_value(), AssertId::PartMissing);
  return *timer_;
}

}  // namespace wr
