#include "wheel_control/commands/SetOrientation.hpp"

namespace wr {

SetOrientation::SetOrientation(Wheel& wheel) : wheel_(wheel) {}

void SetOrientation::execute(Tension tension) {
  wheel_.setOrientation(tension < Tension());
}

}  // namespace wr
