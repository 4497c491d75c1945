#pragma once

#include "services/SystemConstants.hpp"

namespace wr::test {

/// @brief The number N. After N failed reads in a row, the last waiting state begins.
inline constexpr int kWaitingCycles = SystemConstants::instance().waitingCycles();

}  // namespace wr::test
