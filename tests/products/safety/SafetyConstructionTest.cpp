#include <gtest/gtest.h>

#include <array>

#include "main_control/SpySystem.hpp"
#include "products/ProductFixture.hpp"
#include "safety/RetainedProtection.hpp"
#include "safety/RetainedStop.hpp"
#include "safety/RobotStage.hpp"
#include "safety/SafetyBuilder.hpp"
#include "safety/SafetyDirector.hpp"
#include "safety/SafetyPcDirector.hpp"

namespace wr::test {
namespace {

/// The directors of the products with safety functions.
class SafetyDirectors : public ProductFixture {
 protected:
  RetainedStop::Cells cells{};
  RetainedStop memory{cells};
  host::HostEdgeInput enablePin{scheduler, false};
  SafetyDirector director{poolBuilder,
                          builder,
                          {.timebase = time,
                           .edgeTime = time,
                           .memory = memory,
                           .enablePin = enablePin,
                           .velocity = velocity,
                           .direction = direction}};
  SafetyPcDirector pcDirector{poolBuilder, builder, memory};
};

using SafetyDirectorsDeathTest = SafetyDirectors;

/// @brief A robot with safety functions can be built only once.
/// @verifies FR-78
TEST_F(SafetyDirectorsDeathTest, FR78_ConstructionTwiceEndsTheProgram) {
  director.construct();
  EXPECT_DEATH(director.construct(), "assertion 5 failed");
}

/// @brief If a robot receives orders only from the PC, it can be built only once.
/// @verifies FR-78
TEST_F(SafetyDirectorsDeathTest, FR78_ConstructionForThePcTwiceEndsTheProgram) {
  pcDirector.construct();
  EXPECT_DEATH(pcDirector.construct(), "assertion 5 failed");
}

/// @brief Before a robot is built, a call of start() or enablePin() of its director ends the
/// program.
/// @verifies FR-78
TEST_F(SafetyDirectorsDeathTest, FR78_StartBeforeConstructionEndsTheProgram) {
  EXPECT_DEATH(director.start(), "assertion 1 failed");
  EXPECT_DEATH(pcDirector.start(), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(director.enablePin()), "assertion 1 failed");
}

/// @brief If a robot has a PC and a remote control, it sends a Welcome and reports to the PC. It
/// starts in the mode RC.
/// @verifies FR-293
TEST_F(SafetyDirectors, FR293_RobotWithRemoteControlReports) {
  begin(director);
  EXPECT_TRUE(spyBuilder.started);
  connect();
  EXPECT_EQ(cycleWithPc().mode, 0);
  EXPECT_EQ(spy.calls, kHeld);
}

/// @brief If a robot receives orders only from the PC, it sends a Welcome and reports to the PC.
/// Its mode is PC.
/// @verifies FR-293
TEST_F(SafetyDirectors, FR293_RobotForThePcReports) {
  begin(pcDirector);
  EXPECT_TRUE(spyBuilder.started);
  connect();
  EXPECT_EQ(cycleWithPc().mode, 1);
  EXPECT_EQ(spy.calls, kHeld);
}

/// The builder of the safety functions and of one control system.
class SafetyBuilderTest : public testing::Test {
 protected:
  SpyBuilder robot;
  std::array<ControlSystemBuilder*, 1> systems{&robot};
  host::HostScheduler scheduler;
  host::HostEdgeInput emergencyStop{scheduler, false};
  RetainedProtection::Cells cells{};
  RetainedProtection memory{cells};
  SafetyBuilder builder{
      {.wheels = {}, .systems = systems, .emergencyStop = emergencyStop, .memory = memory}};
};

using SafetyBuilderDeathTest = SafetyBuilderTest;

/// @brief Before the control systems are built, a call of start(), system() or tickCommand() of
/// their builder ends the program.
/// @verifies FR-78
TEST_F(SafetyBuilderDeathTest, FR78_UseBeforeConstructionEndsTheProgram) {
  EXPECT_DEATH(builder.start(), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(builder.system()), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(builder.tickCommand()), "assertion 1 failed");
}

/// @brief The last stage accepts eight control systems. If a ninth control system is added, an
/// assertion ends the program.
/// @verifies FR-78
TEST_F(SafetyBuilderDeathTest, FR78_ControlSystemTooManyEndsTheProgram) {
  SpySystem spy;
  RobotStage stage;
  for (int count = 0; count < 8; ++count) {
    stage.add(spy);
  }
  EXPECT_DEATH(stage.add(spy), "assertion 2 failed");
}

/// @brief The control systems are built, started and ticked as a single control system.
/// @verifies FR-293
/// @verifies FR-78
TEST_F(SafetyBuilderTest, FR293_ControlSystemsAreBuiltAsOne) {
  builder.buildActuator();
  builder.buildSensors();
  builder.buildController();
  builder.buildSystem();
  builder.start();
  builder.tickCommand().execute();
  builder.system().hold(1);
  EXPECT_EQ(robot.spy.calls, kHeld);
  EXPECT_TRUE(builder.system().completed(1));
}

/// @brief The safety functions can be wrapped around the control systems only once.
/// @verifies FR-78
TEST_F(SafetyBuilderDeathTest, FR78_ConstructionTwiceEndsTheProgram) {
  builder.buildSystem();
  EXPECT_DEATH(builder.buildSystem(), "assertion 5 failed");
}

}  // namespace
}  // namespace wr::test
