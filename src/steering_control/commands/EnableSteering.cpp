#include "steering_control/commands/EnableSteering.hpp"

#include "steering_control/SteeringDevice.hpp"

namespace wr {

EnableSteering::EnableSteering(SteeringDevice& device) : device_(device) {}

void EnableSteering::execute(StepRate /*rate*/) {
  device_.enable();
}

}  // namespace wr
