#include "safety/k64/stop_memory.hpp"

namespace wr::platform {

namespace {

[[gnu::section(".noinit")]] RetainedStop::Cells stopCells;
[[gnu::section(".noinit")]] RetainedProtection::Cells protectionCells;

}  // namespace

RetainedStop stopMemory(stopCells);
RetainedProtection protectionMemory(protectionCells);

}  // namespace wr::platform
