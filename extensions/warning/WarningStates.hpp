#pragma once

#include <cstdint>

#include "devices/DigitalOutput.hpp"
#include "main_control/operation_states/Reconnecting.hpp"
#include "main_control/operation_states/Waiting.hpp"
#include "main_control/operation_states/WaitingN.hpp"
#include "main_control/operation_states/Working.hpp"
#include "services/SystemConstants.hpp"
#include "warning/WaitingK.hpp"

namespace wr {

/// @brief The operation states of a robot that warns. N is SystemConstants::waitingCycles(). The
/// warning begins after N - 1 successive failed reads, one cycle before the last waiting state.
/// @datatype
struct WarningStates {
  /// @brief Connects each state to its successors.
  /// @param warning output that is on while the robot warns
  explicit WarningStates(DigitalOutput& warning)
      : waiting(working, waitingK, kFailedReads),
        working(waiting),
        waitingK(working, waitingN, warning),
        waitingN(working, reconnecting),
        reconnecting(working) {}

  /// @brief Number of successive failed reads after which the warning begins.
  static constexpr std::uint8_t kFailedReads = SystemConstants::instance().waitingCycles() - 1;
  static_assert(kFailedReads >= 2, "the first failed read must set a state without a warning");

  Waiting waiting;            ///< counts failed reads
  Working working;            ///< the first state
  WaitingK waitingK;          ///< warns
  WaitingN waitingN;          ///< the last waiting state
  Reconnecting reconnecting;  ///< searches for another source of orders
};

}  // namespace wr
