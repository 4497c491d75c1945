#include "steering_control/commands/DisableSteering.hpp"

#include "steering_control/SteeringDevice.hpp"

namespace wr {

DisableSteering::DisableSteering(SteeringDevice& device) : device_(device) {}

void DisableSteering::execute(StepRate /*rate*/) {
  device_.disable();
}

}  // namespace wr
