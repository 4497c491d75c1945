#include "system/OperationStatesReference.hpp"

namespace wr::test {
namespace {

/// @brief In random sequences of orders of the PC, the robot behaves in every cycle like a
/// reference that was written from the requirements. The remote control is silent, and the robot
/// executes each transition of both state machines.
/// @verifies FR-12
/// @verifies FR-13
/// @verifies FR-15
/// @verifies FR-16
/// @verifies FR-17
/// @verifies FR-18
/// @verifies FR-19
/// @verifies FR-20
/// @verifies FR-21
TEST(OperationStatesReference, RobotWithThePcAloneDoesWhatTheReferenceDoes) {
  const int sequences = referenceSequences();
  compareInSequences<SteppedRobot, Comparison>(sequences, sequences / 100);
}

}  // namespace
}  // namespace wr::test
