#include "safety/k64/stop_memory.hpp"

namespace wr::platform {

namespace {

[[gnu::section(".noinit")]] RetainedStop::Cells stopCells;

}  // namespace

RetainedStop stopMemory(stopCells);

}  // namespace wr::platform
