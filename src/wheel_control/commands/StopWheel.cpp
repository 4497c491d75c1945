#include "wheel_control/commands/StopWheel.hpp"

namespace wr {

StopWheel::StopWheel(Wheel& wheel) : wheel_(wheel) {}

void StopWheel::execute(Tension /*tension*/) {
  wheel_.stop();
}

}  // namespace wr
