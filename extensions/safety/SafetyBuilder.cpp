#include "safety/SafetyBuilder.hpp"

#include "services/assertion.hpp"

namespace wr {

SafetyBuilder::Chain::Chain(OrderStage& robot, const Parts& parts)
    : emergencyStop(parts.emergencyStop),
      protectiveStop(robot, emergencyStop, parts.memory),
      ramp(protectiveStop),
      arming(ramp),
      system(arming) {}

void SafetyBuilder::Ticks::add(Command& command) {
  require(count_ < commands_.size(), AssertId::PoolFull);
  commands_[count_] = &command;
  ++count_;
}

void SafetyBuilder::Ticks::watch(ContactWatch& contact) {
  contact_ = &contact;
}

void SafetyBuilder::Ticks::execute() {
  if (contact_ != nullptr) {
    contact_->sample();
  }
  // bound: kWheelCount + 1
  for (Command* command : std::span(commands_).first(count_)) {
    command->execute();
  }
}

SafetyBuilder::SafetyBuilder(const Parts& parts) : parts_(parts) {}

void SafetyBuilder::buildActuator() {
  for (ControlSystemBuilder* builder : parts_.systems) {
    builder->buildActuator();
  }
}

void SafetyBuilder::buildSensors() {
  for (ControlSystemBuilder* builder : parts_.systems) {
    builder->buildSensors();
  }
}

void SafetyBuilder::buildController() {
  std::size_t wheel = 0;
  for (WheelSystemBuilder& builder : parts_.wheels) {
    builder.useAlgorithms(algorithms_[wheel].all());
    ++wheel;
  }
  for (ControlSystemBuilder* builder : parts_.systems) {
    builder->buildController();
  }
}

void SafetyBuilder::buildSystem() {
  require(!chain_, AssertId::PartBuiltTwice);
  for (ControlSystemBuilder* builder : parts_.systems) {
    builder->buildSystem();
    robot_.add(builder->system());
    ticks_.add(builder->tickCommand());
  }
  chain_.emplace(robot_, parts_);
  ticks_.watch(chain_->emergencyStop);
}

void SafetyBuilder::start() {
  require(chain_.has_value(), AssertId::PartMissing);
  for (ControlSystemBuilder* builder : parts_.systems) {
    builder->start();
  }
}

ControlSystem& SafetyBuilder::system() {
  require(chain_.has_value(), AssertId::PartMissing);
  return chain_->system;
}

Command& SafetyBuilder::tickCommand() {
  require(chain_.has_value(), AssertId::PartMissing);
  return ticks_;
}

}  // namespace wr
