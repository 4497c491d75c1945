#include "steering_control/commands/SetTurn.hpp"

#include "steering_control/SteeringDevice.hpp"

namespace wr {

SetTurn::SetTurn(SteeringDevice& device) : device_(device) {}

void SetTurn::execute(StepRate rate) {
  device_.turn(rate);
}

}  // namespace wr
