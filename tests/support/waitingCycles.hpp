#pragma once

#include "services/SystemConstants.hpp"

namespace wr::test {

/// @brief The waiting cycles of the paper: N.
inline constexpr int kWaitingCycles = SystemConstants::instance().waitingCycles();

}  // namespace wr::test
