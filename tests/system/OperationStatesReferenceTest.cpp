#include "system/OperationStatesReference.hpp"

namespace wr::test {
namespace {

/// @brief The PC sends random sequences of orders, and the remote control is silent. In every
/// cycle, the robot behaves like a reference that was written from the requirements. On average,
/// the robot executes each transition of the operation states and of the reading modes at least
/// once in a hundred sequences.
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
