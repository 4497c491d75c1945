#include <gtest/gtest.h>

#include <array>

#include "construction/ControlSystemPoolBuilder.hpp"
#include "construction/DirSystemBuilder.hpp"
#include "construction/MainControllerBuilder.hpp"
#include "construction/RobotDirector.hpp"
#include "construction/WheelSystemBuilder.hpp"
#include "main_control/ControllerFixture.hpp"
#include "sim/host/HostPins.hpp"
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
  host::HostTimebase time;
  host::HostSerialPort port;
  host::HostScheduler scheduler;
  host::HostPins pins{scheduler};
  host::HostThread thread{scheduler, 1};
  host::HostThread wheelThread{scheduler, 2};
  host::HostTimer timer{scheduler};
  host::HostTimer tickTimer{scheduler};
  Pipe<Velocity> velocity;
  Pipe<Angle> direction;
  host::HostWatchdog watchdog{time};
  StartRecord start{ResetCause::Software, FaultKind::Assertion, 3, 0x1234};
  WheelSystemBuilder wheelBuilder{{.pwm = pins.wheels[1].pwm,
                                   .orientation = pins.wheels[1].orientation,
                                   .enable = pins.wheels[1].enable,
                                   .hallA = pins.wheels[1].hall[0],
                                   .hallB = pins.wheels[1].hall[1],
                                   .current = pins.wheels[1].current,
                                   .thread = wheelThread,
                                   .timebase = time,
                                   .wheel = 1}};
  DirSystemBuilder steeringBuilder{{.step = pins.steering.step,
                                    .direction = pins.steering.direction,
                                    .enable = pins.steering.enable,
                                    .leftEnd = pins.steering.leftEnd,
                                    .rightEnd = pins.steering.rightEnd,
                                    .angle = pins.steering.angle,
                                    .timebase = time}};
  std::array<ControlSystemBuilder*, 2> systemBuilders{&wheelBuilder, &steeringBuilder};
  ControlSystemPoolBuilder poolBuilder{tickTimer, systemBuilders};
  MainControllerBuilder::Devices devices{
      .thread = thread,
      .cycleTimer = timer,
      .timebase = time,
      .pcPort = port,
      .watchdog = watchdog,
      .start = start,
      .remoteControl =
          MainControllerBuilder::RemoteControlDevices{.velocityPin = pins.remoteControl[0],
                                                      .directionPin = pins.remoteControl[1],
                                                      .velocity = velocity,
                                                      .direction = direction}};
  MainControllerBuilder builder{devices};
  RobotDirector director{poolBuilder, builder};

  // Starts the whole robot. Then runs enough ticks of the second timer for a measurement of the
  // steering angle.
  void startRobot() {
    director.construct();
    timer.connect([this] { builder.clock().expired(); });
    tickTimer.connect([this] { poolBuilder.timer().expired(); });
    director.start();
    for (int tick = 0; tick < 8; ++tick) {
      tickTimer.periodPassed();
    }
  }
};

/// @brief The built controller starts in the mode RC.
/// @verifies FR-10
TEST_F(BuilderTest, FR10_ControllerBeginsInModeRc) {
  director.construct();
  EXPECT_EQ(builder.controller().getMode().id(), ModeId::RC);
}

/// @brief Each of the two built modes has the other mode as its successor.
/// @verifies FR-17
TEST_F(BuilderTest, FR17_ModesSucceedEachOther) {
  director.construct();
  MainController& controller = builder.controller();
  controller.getMode().changeMode(controller);
  EXPECT_EQ(controller.getMode().id(), ModeId::PC);
  controller.getMode().changeMode(controller);
  EXPECT_EQ(controller.getMode().id(), ModeId::RC);
}

/// @brief The constructed robot runs no cycle before its start. After its start, the robot runs a
/// cycle for each pulse of its timer.
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

/// @brief An order of the remote control sets one velocity for all wheels, and the angle of the
/// steering.
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

/// @brief Only the cycles of the built controller refresh the watchdog of the platform.
/// Construction and start do not refresh it.
/// @verifies FR-74
TEST_F(BuilderTest, FR74_CyclesRefreshTheWatchdogOfThePlatform) {
  startRobot();
  EXPECT_EQ(watchdog.refreshes(), 0U);
  timer.periodPassed();
  EXPECT_EQ(watchdog.refreshes(), 1U);
}

/// @brief The Welcome of the built robot contains the data of the start that the platform recorded.
/// @verifies FR-76
TEST_F(BuilderTest, FR76_WelcomeTellsTheStartOfThePlatform) {
  startRobot();
  scenario::PcSender pc;
  port.arrive(pc.hello());
  timer.periodPassed();
  const std::optional<scenario::PcWelcome> welcome =
      scenario::welcomeOf(scenario::bodies(port.takeSent()).at(0));
  ASSERT_TRUE(welcome);
  EXPECT_EQ(welcome->resetCause, 7);
  EXPECT_EQ(welcome->fault, 1);
  EXPECT_EQ(welcome->faultNumber, 3);
  EXPECT_EQ(welcome->faultAddress, 0x1234U);
}

/// @brief After hold() was called for a cycle, the control systems of the started robot have
/// completed this cycle.
/// @verifies FR-78
TEST_F(BuilderTest, FR78_EveryPartIsMadeOnce) {
  startRobot();
  EXPECT_FALSE(poolBuilder.pool().completed(1));
  poolBuilder.pool().hold(1);
  EXPECT_TRUE(poolBuilder.pool().completed(1));
}

/// @brief The start of the robot starts the second timer. At each tick, the second timer executes
/// the commands of the wheels and the steering. The command of a wheel and the command of the
/// steering each request a sample.
/// @verifies FR-100
TEST_F(BuilderTest, FR100_SecondTimerExecutesTheCommandsOfTheSystems) {
  director.construct();
  tickTimer.connect([this] { poolBuilder.timer().expired(); });
  EXPECT_EQ(tickTimer.period(), Microseconds(0));
  director.start();
  EXPECT_EQ(tickTimer.period(), milliseconds(1));
  for (int tick = 0; tick < 8; ++tick) {
    tickTimer.periodPassed();
  }
  EXPECT_TRUE(pins.wheels[1].current.sample().has_value());
  EXPECT_TRUE(pins.steering.angle.sample().has_value());
}

/// @brief The pulses on the two pins of the remote control become the velocity signal and the
/// direction signal.
/// @verifies FR-52
TEST_F(BuilderTest, FR52_PulsesOnThePinsReachTheSignals) {
  director.construct();
  pins.remoteControl[0].connect([this] { builder.velocityPin().serve(); });
  pins.remoteControl[1].connect([this] { builder.directionPin().serve(); });
  for (int pulse = 0; pulse < 2; ++pulse) {
    pins.remoteControl[0].drive(true);
    pins.remoteControl[1].drive(true);
    time.advance(Microseconds(1250));
    pins.remoteControl[1].drive(false);
    time.advance(Microseconds(750));
    pins.remoteControl[0].drive(false);
    time.advance(milliseconds(18));
  }
  ASSERT_TRUE(velocity.read().has_value());
  EXPECT_EQ(velocity.read()->value, Velocity(3000));
  ASSERT_TRUE(direction.read().has_value());
  EXPECT_EQ(direction.read()->value, Angle(-1600));
}

/// @brief If a robot receives orders only from the PC, it starts in the mode PC and stays in this
/// mode.
/// @verifies FR-10
TEST_F(BuilderTest, FR10_RobotForThePcHasOneMode) {
  director.constructForPc();
  MainController& controller = builder.controller();
  EXPECT_EQ(controller.getMode().id(), ModeId::PC);
  controller.getMode().changeMode(controller);
  EXPECT_EQ(controller.getMode().id(), ModeId::PC);
}

using BuilderDeathTest = BuilderTest;

/// @brief A part cannot be requested before it is built.
/// @verifies FR-78
TEST_F(BuilderDeathTest, FR78_ProductIsMissingBeforeItIsBuilt) {
  EXPECT_DEATH(static_cast<void>(poolBuilder.pool()), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(poolBuilder.timer()), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(builder.controller()), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(builder.clock()), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(builder.pcReader()), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(builder.rcReader()), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(builder.connection()), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(builder.velocityPin()), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(builder.directionPin()), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(wheelBuilder.sensor()), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(wheelBuilder.tickCommand()), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(wheelBuilder.system()), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(steeringBuilder.tickCommand()), "assertion 1 failed");
  EXPECT_DEATH(static_cast<void>(steeringBuilder.system()), "assertion 1 failed");
  EXPECT_DEATH(wheelBuilder.start(), "assertion 1 failed");
  EXPECT_DEATH(steeringBuilder.start(), "assertion 1 failed");
  EXPECT_DEATH(director.start(), "assertion 1 failed");
}

/// @brief A construction step cannot be executed when the parts that it needs are missing.
/// @verifies FR-78
TEST_F(BuilderDeathTest, FR78_StepNeedsItsParts) {
  EXPECT_DEATH(poolBuilder.buildPool(), "assertion 1 failed");
  EXPECT_DEATH(poolBuilder.buildTimer(), "assertion 1 failed");
  poolBuilder.buildSystems();
  poolBuilder.buildPool();
  EXPECT_DEATH(builder.buildModes(), "assertion 1 failed");
  EXPECT_DEATH(builder.buildPcMode(), "assertion 1 failed");
  EXPECT_DEATH(builder.buildController(poolBuilder.pool()), "assertion 1 failed");
  EXPECT_DEATH(builder.buildClock(), "assertion 1 failed");
  builder.buildConnection();
  EXPECT_DEATH(builder.buildModes(), "assertion 1 failed");
  EXPECT_DEATH(builder.buildController(poolBuilder.pool()), "assertion 1 failed");
  builder.buildRemoteControl();
  builder.buildModes();
  EXPECT_DEATH(builder.buildController(poolBuilder.pool()), "assertion 1 failed");
}

/// @brief The modes need the link to the PC, even when the remote control is built.
/// @verifies FR-78
TEST_F(BuilderDeathTest, FR78_ModesNeedTheLink) {
  builder.buildRemoteControl();
  EXPECT_DEATH(builder.buildModes(), "assertion 1 failed");
}

/// @brief The controller needs the modes, even when everything else is built.
/// @verifies FR-78
TEST_F(BuilderDeathTest, FR78_ControllerNeedsItsModes) {
  poolBuilder.buildSystems();
  poolBuilder.buildPool();
  builder.buildConnection();
  builder.buildStates();
  EXPECT_DEATH(builder.buildController(poolBuilder.pool()), "assertion 1 failed");
}

/// @brief buildController() needs the link to the PC, even when the test passes its own mode to the
/// builder.
/// @verifies FR-78
TEST_F(BuilderDeathTest, FR78_ControllerNeedsTheLink) {
  poolBuilder.buildSystems();
  poolBuilder.buildPool();
  FakeMode mode(ModeId::PC);
  builder.useModes(mode, {});
  builder.buildStates();
  EXPECT_DEATH(builder.buildController(poolBuilder.pool()), "assertion 1 failed");
}

/// @brief Wheel and steering need their sensors, even when everything else is built.
/// @verifies FR-78
TEST_F(BuilderDeathTest, FR78_SystemNeedsItsSensors) {
  for (ControlSystemBuilder* system : systemBuilders) {
    system->buildActuator();
    system->buildController();
    EXPECT_DEATH(system->buildSystem(), "assertion 1 failed");
  }
}

/// @brief Wheel and steering cannot be built when one of their parts is missing.
/// @verifies FR-78
TEST_F(BuilderDeathTest, FR78_SystemNeedsItsParts) {
  EXPECT_DEATH(wheelBuilder.buildSensors(), "assertion 1 failed");
  EXPECT_DEATH(wheelBuilder.buildController(), "assertion 1 failed");
  EXPECT_DEATH(wheelBuilder.buildSystem(), "assertion 1 failed");
  EXPECT_DEATH(steeringBuilder.buildController(), "assertion 1 failed");
  EXPECT_DEATH(steeringBuilder.buildSystem(), "assertion 1 failed");
  wheelBuilder.buildActuator();
  wheelBuilder.buildSensors();
  EXPECT_DEATH(wheelBuilder.buildSystem(), "assertion 1 failed");
  steeringBuilder.buildActuator();
  EXPECT_DEATH(steeringBuilder.buildSystem(), "assertion 1 failed");
  steeringBuilder.buildSensors();
  EXPECT_DEATH(steeringBuilder.buildSystem(), "assertion 1 failed");
}

/// @brief The remote control cannot be built on a platform that has no remote control.
/// @verifies FR-78
TEST_F(BuilderDeathTest, FR78_RemoteControlNeedsItsDevices) {
  devices.remoteControl.reset();
  MainControllerBuilder without(devices);
  EXPECT_DEATH(without.buildRemoteControl(), "assertion 1 failed");
}

/// @brief No part can be built twice.
/// @verifies FR-78
TEST_F(BuilderDeathTest, FR78_NoPartTwice) {
  director.construct();
  EXPECT_DEATH(poolBuilder.buildSystems(), "assertion 5 failed");
  EXPECT_DEATH(poolBuilder.buildPool(), "assertion 5 failed");
  EXPECT_DEATH(poolBuilder.buildTimer(), "assertion 5 failed");
  EXPECT_DEATH(builder.buildConnection(), "assertion 5 failed");
  EXPECT_DEATH(builder.buildRemoteControl(), "assertion 5 failed");
  EXPECT_DEATH(builder.buildModes(), "assertion 5 failed");
  EXPECT_DEATH(builder.buildPcMode(), "assertion 5 failed");
  EXPECT_DEATH(builder.useModes(builder.controller().getMode(), {}), "assertion 5 failed");
  EXPECT_DEATH(builder.buildStates(), "assertion 5 failed");
  FakeState state(OperationStateId::Working);
  EXPECT_DEATH(builder.useStates(state), "assertion 5 failed");
  EXPECT_DEATH(builder.buildController(poolBuilder.pool()), "assertion 5 failed");
  EXPECT_DEATH(builder.buildClock(), "assertion 5 failed");
  for (ControlSystemBuilder* system : systemBuilders) {
    EXPECT_DEATH(system->buildActuator(), "assertion 5 failed");
    EXPECT_DEATH(system->buildSensors(), "assertion 5 failed");
    EXPECT_DEATH(system->buildController(), "assertion 5 failed");
    EXPECT_DEATH(system->buildSystem(), "assertion 5 failed");
  }
  EXPECT_DEATH(wheelBuilder.useAlgorithms({}), "assertion 5 failed");
}

}  // namespace
}  // namespace wr::test
