#pragma once

#include <array>

#include "construction/ControlSystemBuilder.hpp"
#include "construction/ControlSystemPoolBuilder.hpp"
#include "construction/WheelSystemBuilder.hpp"
#include "units/SetPoints.hpp"

namespace wr::platform {

/// @brief Builders of the wheels, with the devices of the board.
extern std::array<WheelSystemBuilder, kWheelCount> wheelBuilders;

/// @brief Builders of all control systems: of the wheels and of the steering.
extern const std::array<ControlSystemBuilder*, kWheelCount + 1> systemBuilders;

/// @brief Builds the control systems of the product, and handles their ticks. A product uses one
/// pool, with or without safety functions.
extern ControlSystemPoolBuilder poolBuilder;

}  // namespace wr::platform
