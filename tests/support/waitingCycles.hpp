#pragma once

#include "services/SystemConstants.hpp"

namespace wr::test {

/// @brief Number N of waiting cycles in the paper.
inline constexpr int kWaitingCycles = SystemConstants::instance().waitingCycles();

}  // namespace wr::test
