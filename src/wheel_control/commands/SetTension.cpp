#include "wheel_control/commands/SetTension.hpp"

namespace wr {

SetTension::SetTension(Wheel& wheel) : wheel_(wheel) {}

void SetTension::execute(Tension tension) {
  wheel_.setTension(tension < Tension() ? -tension : tension);
}

}  // namespace wr
