#include "system/OperationStatesReference.hpp"

namespace wr::test {
namespace {

/// @brief In random sequences of orders of the PC, while the remote control is silent, the robot
/// behaves in every cycle like a reference written from the requirements, and executes each
/// transition of both machines.
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
