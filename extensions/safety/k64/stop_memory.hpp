#pragma once

#include "safety/RetainedProtection.hpp"
#include "safety/RetainedStop.hpp"

namespace wr::platform {

/// @brief The stop order of the PC, stored in memory that a reset does not change.
extern RetainedStop stopMemory;

/// @brief The protective stop, stored in memory that a reset does not change.
extern RetainedProtection protectionMemory;

}  // namespace wr::platform
