#include <gtest/gtest.h>

#include "construction/ControlSystemPoolBuilder.hpp"
#include "construction/MainControllerBuilder.hpp"
#include "construction/RobotDirector.hpp"
#include "sim/host/HostScheduler.hpp"
#include "sim/host/HostSerialPort.hpp"
#include "sim/host/HostThread.hpp"
#include "sim/host/HostTimebase.hpp"
#include "sim/host/HostTimer.hpp"
#include "sim/host/HostWatchdog.hpp"
#include "sim/scenario/PcFrames.hpp"

namespace wr::test {
namespace {

class BuilderTest : public testing::Test {
 protected:
  HostTimebase time;
  HostSerialPort port;
  HostScheduler scheduler;
  HostThread thread{scheduler, 1};
  HostTimer timer{scheduler};
  Pipe<Velocity> velocity;
  Pipe<Angle> direction;
  HostWatchdog watchdog{time};
  StartRecord start{ResetCause::Software, FaultKind::Assertion, 3, 0x1234};
  ControlSystemPoolBuilder poolBuilder;
  MainControllerBuilder builder{{.thread = thread,
                                 .cycleTimer = timer,
                                 .timebase = time,
                                 .pcPort = port,
                                 .rcVelocity = velocity,
                                 .rcDirection = direction,
                                 .watchdog = watchdog,
                                 .start = start}};
  RobotDirector director{poolBuilder, builder};
};

/// @brief The controller that is built begins in the mode RC.
/// @verifies FR-10
TEST_F(BuilderTest, FR10_ControllerBeginsInModeRc) {
  director.construct();
  EXPECT_EQ(builder.controller().getMode().id(), ModeId::RC);
}

/// @brief Each mode that is built changes to the other.
/// @verifies FR-17
TEST_F(BuilderTest, FR17_ModesSucceedEachOther) {
  director.construct();
  MainController& controller = builder.controller();
  controller.getMode().changeMode(controller);
  EXPECT_EQ(controller.getMode().id(), ModeId::PC);
  controller.getMode().changeMode(controller);
  EXPECT_EQ(controller.getMode().id(), ModeId::RC);
}

/// @brief The robot that is constructed runs no cycle before it is started, and then one for each pulse
/// of its timer.
/// @verifies FR-1
TEST_F(BuilderTest, FR1_StartStartsControllerAndTimer) {
  director.construct();
  timer.connect([this] { builder.clock().expired(); });
  timer.periodPassed();
  EXPECT_EQ(builder.controller().getData().cycle(), 0U);
  director.start();
  EXPECT_EQ(timer.period(), milliseconds(100));
  timer.periodPassed();
  EXPECT_EQ(builder.controller().getData().cycle(), 1U);
  EXPECT_FALSE(timer.pending());
}

/// @brief The remote control's order sets one velocity for all wheels.
/// @verifies FR-51
TEST_F(BuilderTest, FR51_RcSignalsReachTheSetPoints) {
  director.construct();
  velocity.write(Velocity(123), time.now());
  direction.write(Angle(-45), time.now());
  builder.controller().read();
  const SetPoints& setPoints = *builder.controller().getData().setPoints();
  EXPECT_EQ(setPoints.steering, Angle(-45));
  for (const WheelSetPoint& wheel : setPoints.wheels) {
    EXPECT_EQ(wheel, (WheelSetPoint{WheelQuantity::Velocity, 123}));
  }
}

/// @brief The watchdog of the platform is refreshed by the cycles of the controller that is built, and
/// by no step of its construction or start.
/// @verifies FR-74
TEST_F(BuilderTest, FR74_CyclesRefreshTheWatchdogOfThePlatform) {
  director.construct();
  timer.connect([this] { builder.clock().expired(); });
  director.start();
  EXPECT_EQ(watchdog.refreshes(), 0U);
  timer.periodPassed();
  EXPECT_EQ(watchdog.refreshes(), 1U);
}

/// @brief The Welcome of the robot that is built tells the start that the platform recorded.
/// @verifies FR-76
TEST_F(BuilderTest, FR76_WelcomeTellsTheStartOfThePlatform) {
  director.construct();
  timer.connect([this] { builder.clock().expired(); });
  director.start();
  PcSender pc;
  port.arrive(pc.hello());
  timer.periodPassed();
  const std::optional<PcWelcome> welcome = welcomeOf(bodies(port.takeSent()).at(0));
  ASSERT_TRUE(welcome);
  EXPECT_EQ(welcome->resetCause, 7);
  EXPECT_EQ(welcome->faultKind, 1);
  EXPECT_EQ(welcome->faultNumber, 3);
  EXPECT_EQ(welcome->faultAddress, 0x1234U);
}

/// @brief The pool that is built is empty.
TEST_F(BuilderTest, PoolIsEmpty) {
  poolBuilder.buildPool();
  EXPECT_TRUE(poolBuilder.pool().completed(1));
}

using BuilderDeathTest = BuilderTest;

/// @brief A product that was not built cannot be had.
TEST_F(BuilderDeathTest, ProductIsMissingBeforeItIsBuilt) {
  EXPECT_DEATH(static_cast<void>(poolBuilder.pool()), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(builder.controller()), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(builder.clock()), "assertion 1 failed");
  EXPECT_DEATH(director.start(), "assertion 1 failed");
}

/// @brief A step whose parts are missing cannot be done.
TEST_F(BuilderDeathTest, StepNeedsItsParts) {
  poolBuilder.buildPool();
  EXPECT_DEATH(builder.buildConnection(), "assertion 1 failed");
  EXPECT_DEATH(builder.buildModes(), "assertion 1 failed");
  EXPECT_DEATH(builder.buildController(poolBuilder.pool()), "assertion 1 failed");
  EXPECT_DEATH(builder.buildClock(), "assertion 1 failed");
  builder.buildReaders();
  EXPECT_DEATH(builder.buildModes(), "assertion 1 failed");
  builder.buildConnection();
  EXPECT_DEATH(builder.buildController(poolBuilder.pool()), "assertion 1 failed");
  builder.buildModes();
  EXPECT_DEATH(builder.buildController(poolBuilder.pool()), "assertion 1 failed");
}

}  // namespace
}  // namespace wr::test
