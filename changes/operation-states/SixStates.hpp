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

/// @brief Six operation states: the five states of the robot that warns, and a state that waits for
/// a cycle after the search for a source.
struct SixStates {
  /// @brief Constructs the states and binds each to its successors.
  /// @param warning output that is on during a warning
  explicit SixStates(DigitalOutput& warning)
      : waiting(working, waitingK, SystemConstants::instance().waitingCycles() - 1),
        working(waiting),
        waitingK(working, waitingN, warning),
        waitingN(working, reconnecting),
        reconnecting(static_cast<OperationState&>(resuming)),
        resuming(working, waiting) {}

  Waiting waiting;            ///< counts failed reads
  Working working;            ///< the first state
  WaitingK waitingK;          ///< warns
  WaitingN waitingN;          ///< the last waiting state
  Reconnecting reconnecting;  ///< looks for another source
  Resuming resuming;          ///< holds for one more cycle
};

}  // namespace wr
