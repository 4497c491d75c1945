#pragma once

#include <array>

#include "construction/ControlSystemBuilder.hpp"
#include "construction/ControlSystemPoolBuilder.hpp"
#include "construction/WheelSystemBuilder.hpp"
#include "units/SetPoints.hpp"

namespace wr::platform {

/// @brief Builders of the control systems of the wheels. Each builder uses the devices of its
/// wheel.
extern std::array<WheelSystemBuilder, kWheelCount> wheelBuilders;

/// @brief Builders of all control systems, that is, of the wheels and of the steering.
extern const std::array<ControlSystemBuilder*, kWheelCount + 1> systemBuilders;

/// @brief Builder of the pool of all control systems. The timer of this builder passes each tick to
/// the control systems. Each product contains one definition of this builder, with safety functions
/// or without them.
extern ControlSystemPoolBuilder poolBuilder;

}  // namespace wr::platform
