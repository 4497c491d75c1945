#pragma once

#include "safety/RetainedStop.hpp"

namespace wr::platform {

/// @brief Stop of the PC, in memory that a reset leaves as it is.
extern RetainedStop stopMemory;

}  // namespace wr::platform
