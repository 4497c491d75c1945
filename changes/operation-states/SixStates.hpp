#pragma once

#include "devices/DigitalOutput.hpp"
#include "main_control/operation_states/Reconnecting.hpp"
#include "main_control/operation_states/Waiting.hpp"
#include "main_control/operation_states/WaitingN.hpp"
#include "main_control/operation_states/Working.hpp"
#include "operation-states/Resuming.hpp"
#include "services/SystemConstants.hpp"
#include "warning/WaitingK.hpp"

namespace wr {

/// @brief Six operation states: the five states of the product weeding_robot_warning, and a state
/// in which the robot stands still for one cycle after the search for a source of orders.
struct SixStates {
  /// @brief Connects each state to its successors.
  /// @param warning output that is on while the robot warns
  explicit SixStates(DigitalOutput& warning)
      : waiting(working, waitingK, SystemConstants::instance().waitingCycles() - 1),
        working(waiting),
        waitingK(working, waitingN, warning),
        waitingN(working, reconnecting),
        reconnecting(static_cast<OperationState&>(resuming)),
        resuming(working, waiting) {}

  Waiting waiting;            ///< counts failed reads
  Working working;            ///< follows new orders; it is the first state
  WaitingK waitingK;          ///< warns
  WaitingN waitingN;          ///< the last waiting state
  Reconnecting reconnecting;  ///< searches for another source of orders
  Resuming resuming;          ///< keeps the robot at rest for one more cycle
};

}  // namespace wr
