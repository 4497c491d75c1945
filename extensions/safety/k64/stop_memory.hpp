#pragma once

#include "safety/RetainedProtection.hpp"
#include "safety/RetainedStop.hpp"

namespace wr::platform {

/// @brief Stop of the PC, in memory that a reset does not change.
extern RetainedStop stopMemory;

/// @brief Protective stop, in memory that a reset does not change.
extern RetainedProtection protectionMemory;

}  // namespace wr::platform
