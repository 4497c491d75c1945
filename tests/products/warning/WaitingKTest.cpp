#include "warning/WaitingK.hpp"

#include "main_control/ControllerFixture.hpp"
#include "sim/host/HostDigitalOutput.hpp"

namespace wr::test {
namespace {

class WaitingKTest : public ControllerFixture {
 protected:
  WaitingKTest() { controller.changeOpState(waitingK); }

  void read(bool message) {
    first.message = message;
    controller.read();
  }

  // Returns true if a fake state is the current state.
  bool isCurrent(FakeState& fake) {
    fake.steps.clear();
    controller.control();
    return fake.steps == std::vector<std::string>{"control"};
  }

  host::HostDigitalOutput warning;
  WaitingK waitingK{state, other, warning};
};

/// @brief In its control step, the state WaitingK switches the warning on. The control systems
/// follow the last set-points.
/// @verifies FR-152
TEST_F(WaitingKTest, FR152_WarnsAndGoesOn) {
  EXPECT_FALSE(warning.isOn());
  data.saveSetPoints({.orderId = 5, .steering = Angle(30)});
  controller.control();
  EXPECT_TRUE(warning.isOn());
  EXPECT_EQ(system.calls, kControlled);
  EXPECT_EQ(system.applied.steering, Angle(30));
}

/// @brief In the state WaitingK, a message switches the warning off. The message is read, and the
/// working state follows.
/// @verifies FR-152
TEST_F(WaitingKTest, FR152_MessageEndsTheWarning) {
  controller.control();
  read(true);
  EXPECT_FALSE(warning.isOn());
  EXPECT_EQ(first.reads, 1);
  EXPECT_TRUE(isCurrent(state));
}

/// @brief In the state WaitingK, a failed read switches the warning off. The next state follows,
/// and the mode does not change.
/// @verifies FR-152
TEST_F(WaitingKTest, FR152_FailedReadSetsTheNextState) {
  controller.control();
  read(false);
  EXPECT_FALSE(warning.isOn());
  EXPECT_EQ(first.reads, 0);
  EXPECT_EQ(first.changes, 0);
  EXPECT_TRUE(isCurrent(other));
}

/// @brief The report contains the number of the state WaitingK.
/// @verifies FR-152
TEST_F(WaitingKTest, FR152_ReportTellsTheState) {
  connect();
  controller.write();
  EXPECT_EQ(sentReport().state, 4);
}

}  // namespace
}  // namespace wr::test
