#pragma once

#include "construction/ControlSystemPoolBuilder.hpp"

namespace wr::platform {

/// @brief Makes the control systems of the four wheels and of the steering, with the devices of the
/// board. All products have them; their interrupts are handled here.
extern ControlSystemPoolBuilder poolBuilder;

}  // namespace wr::platform
