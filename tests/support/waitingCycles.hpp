#pragma once

#include "services/SystemConstants.hpp"

namespace wr::test {

/// @brief The number N of failed reads in a row that lead to the last waiting state.
inline constexpr int kWaitingCycles = SystemConstants::instance().waitingCycles();

}  // namespace wr::test
