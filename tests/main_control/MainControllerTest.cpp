#include "main_control/MainController.hpp"

#include <utility>

#include "main_control/ControllerFixture.hpp"
#include "main_control/ControllerTimeOut.hpp"

namespace wr::test {
namespace {

using MainControllerTest = ControllerFixture;
using Steps = std::vector<std::string>;

/// @brief Before the start, a clock pulse begins no cycle and counts no overrun.
/// @verifies FR-1
TEST_F(MainControllerTest, FR1_NoCycleBeforeStart) {
  controller.clockPulse();
  EXPECT_EQ(data.cycle(), 0U);
  EXPECT_EQ(thread.overruns(), 0U);
}

/// @brief At each clock pulse, one cycle runs.
/// @verifies FR-1
TEST_F(MainControllerTest, FR1_EachClockPulseRunsOneCycle) {
  controller.start();
  controller.clockPulse();
  EXPECT_EQ(data.cycle(), 1U);
  controller.clockPulse();
  EXPECT_EQ(data.cycle(), 2U);
}

/// @brief The command of the cycle timer begins a cycle.
/// @verifies FR-1
TEST_F(MainControllerTest, FR1_TimeOutBeginsACycle) {
  controller.start();
  ControllerTimeOut timeOut(controller);
  timeOut.execute();
  EXPECT_EQ(data.cycle(), 1U);
}

/// @brief A cycle reads once, then controls once, then writes once.
/// @verifies FR-2
TEST_F(MainControllerTest, FR2_CycleReadsControlsWrites) {
  controller.start();
  controller.clockPulse();
  EXPECT_EQ(state.steps, (Steps{"read without message", "control", "write"}));
}

/// @brief A read can change the operation state. The new state then executes the control step and
/// the write step.
/// @verifies FR-3
TEST_F(MainControllerTest, FR3_StateAfterTheReadControlsAndWrites) {
  state.next = &other;
  controller.start();
  controller.clockPulse();
  EXPECT_EQ(state.steps, (Steps{"read without message"}));
  EXPECT_EQ(other.steps, (Steps{"control", "write"}));
}

/// @brief The initial mode is the mode that was passed to the constructor.
/// @verifies FR-10
TEST_F(MainControllerTest, FR10_BeginsWithTheInitialMode) {
  EXPECT_EQ(&controller.getMode(), &first);
}

/// @brief Orders are read from the mode that was set last.
/// @verifies FR-11
/// @verifies FR-12
TEST_F(MainControllerTest, FR12_ReadsFromThePresentModeOnly) {
  first.message = true;
  second.message = true;
  controller.changeMode(second);
  controller.read();
  EXPECT_EQ(first.reads, 0);
  EXPECT_EQ(second.reads, 1);
}

/// @brief Without set-points, applyControl() holds the control systems.
/// @verifies FR-22
TEST_F(MainControllerTest, FR22_HoldsWithoutSetPoints) {
  controller.applyControl();
  EXPECT_EQ(system.calls, kHeld);
}

/// @brief As soon as set-points are stored, applyControl() passes these set-points to the control
/// systems.
/// @verifies FR-14
TEST_F(MainControllerTest, FR14_AppliesTheSetPoints) {
  data.saveSetPoints({.orderId = 77});
  controller.applyControl();
  EXPECT_EQ(system.calls, kControlled);
  EXPECT_EQ(system.applied.orderId, 77);
}

/// @brief If an order with an acknowledgement is neutral, it releases latched faults of the control
/// systems. If it would move a wheel, no fault is released, and the control systems are held.
/// @verifies FR-299
TEST_F(MainControllerTest, FR299_OnlyANeutralOrderAcknowledges) {
  SetPoints order{.acknowledge = true};
  data.saveSetPoints(order);
  controller.applyControl();
  EXPECT_EQ(system.calls, kAcknowledged);
  system.calls.clear();
  order.wheels[3].value = 1;
  data.saveSetPoints(order);
  controller.applyControl();
  EXPECT_EQ(system.calls, kHeld);
}

/// @brief A waiting cycle does not repeat the acknowledgement of the order that was read last.
/// After such an order, a waiting cycle holds the control systems.
/// @verifies FR-299
TEST_F(MainControllerTest, FR299_AWaitingCycleDoesNotAcknowledge) {
  data.saveSetPoints({.acknowledge = true});
  data.beginCycle(Instant(1));
  controller.applyControl();
  EXPECT_EQ(system.calls, kHeld);
}

/// @brief If any mode reports a stop, the control systems are held. The operation state still runs
/// in every cycle.
/// @verifies FR-21
TEST_F(MainControllerTest, FR21_StopOfAnyModeHolds) {
  data.saveSetPoints({});
  controller.start();
  for (FakeMode* mode : {&first, &second}) {
    system.calls.clear();
    state.steps.clear();
    mode->stop = true;
    controller.clockPulse();
    EXPECT_EQ(system.calls, kHeld);
    EXPECT_EQ(state.steps, (Steps{"read without message", "control", "write"}));
    mode->stop = false;
  }
  system.calls.clear();
  controller.clockPulse();
  EXPECT_EQ(system.calls, kControlled);
}

/// @brief The report contains the state, the mode, the source and the set-points after the read.
/// @verifies FR-60
/// @verifies FR-61
TEST_F(MainControllerTest, FR61_ReportTellsTheCycleAfterTheRead) {
  connect();
  controller.start();
  controller.changeMode(second);
  second.message = true;
  state.next = &other;
  time.advance(milliseconds(400));
  controller.clockPulse();
  const scenario::PcReport report = sentReport();
  EXPECT_EQ(report.cycle, 1U);
  EXPECT_EQ(report.timeMs, 400U);
  EXPECT_EQ(report.state, 3);
  EXPECT_EQ(report.mode, 1);
  EXPECT_EQ(report.source, 1);
  EXPECT_EQ(report.orderId, 1);
  EXPECT_TRUE(report.orderRead());
}

/// @brief Two of the counts of processor cycles in the report are correct. The first count begins
/// at the clock pulse of the previous control cycle and ends at the clock pulse of this control
/// cycle. It does not include the time in which the processor slept. The second count begins at the
/// clock pulse of this control cycle and ends when this control cycle starts.
/// @verifies FR-302
TEST_F(MainControllerTest, FR302_ReportTellsWhatTheCyclesCost) {
  connect();
  controller.start();
  time.work(500);
  controller.clockPulse();
  EXPECT_EQ(sentReport().awakeCycles, 0U);
  time.work(3000);
  controller.clockPulse();
  const scenario::PcReport report = sentReport();
  EXPECT_EQ(report.awakeCycles, 3000U);
  EXPECT_EQ(report.startCycles, 0U);
  EXPECT_EQ(report.reportCycles, 0U);
}

/// @brief If a clock pulse is lost, the count of the processor cycles without sleep still begins at
/// the clock pulse of the previous control cycle.
/// @verifies FR-302
TEST_F(MainControllerTest, FR302_ALostPulseDoesNotShortenTheCount) {
  connect();
  controller.start();
  int late = 2;
  system.work = [&] {
    while (late > 0) {
      --late;
      time.work(1000);
      controller.clockPulse();
    }
  };
  controller.clockPulse();
  const std::vector<scenario::Bytes> sent = scenario::bodies(port.takeSent());
  ASSERT_EQ(sent.size(), 2U);
  EXPECT_EQ(scenario::reportOf(sent[1])->awakeCycles, 2000U);
  EXPECT_EQ(scenario::reportOf(sent[1])->startCycles, 0U);
}

/// @brief A report contains the number of processor cycles that the previous cycle needed from its
/// clock pulse to its report.
/// @verifies FR-160
TEST_F(MainControllerTest, FR160_ReportTellsWhatThePreviousReportCost) {
  connect();
  controller.start();
  system.work = [this] { time.work(700); };
  controller.clockPulse();
  EXPECT_EQ(sentReport().reportCycles, 0U);
  controller.clockPulse();
  EXPECT_EQ(sentReport().reportCycles, 700U);
}

/// @brief In a cycle whose order has an acknowledgement, the report shows that the control systems
/// are held. This is true for neutral orders and for orders that would move a wheel. In a cycle in
/// which the control systems follow the set-points, the report shows that they are not held.
/// @verifies FR-306
TEST_F(MainControllerTest, FR306_ReportTellsThatTheSystemsAreHeld) {
  connect();
  controller.start();
  SetPoints order;
  first.onServe = [&] { data.saveSetPoints(order); };  // the cycle reads the order
  const auto calls = [&](const SetPoints& present) {
    order = present;
    system.calls.clear();
    controller.clockPulse();
    return system.calls;
  };
  const SetPoints neutral{.acknowledge = true};
  SetPoints moving = neutral;
  moving.wheels[3].value = 1;
  EXPECT_EQ(calls(neutral), kAcknowledged);
  EXPECT_TRUE(sentReport().held());
  EXPECT_EQ(calls({}), kControlled);
  EXPECT_FALSE(sentReport().held());
  EXPECT_EQ(calls(moving), kHeld);
  EXPECT_TRUE(sentReport().held());
  EXPECT_EQ(calls({}), kControlled);
  EXPECT_FALSE(sentReport().held());
}

/// @brief If the control systems are first held and then follow set-points in the same cycle, the
/// report shows that the systems are not held.
/// @verifies FR-306
TEST_F(MainControllerTest, FR306_ControlAfterAHoldIsNoHold) {
  data.saveSetPoints({});
  controller.holdSystems();
  controller.applyControl();
  EXPECT_FALSE(data.report(OperationStateId::Working, ModeId::PC, {}).held);
}

/// @brief Without a connection, no report is sent.
/// @verifies FR-60
TEST_F(MainControllerTest, FR60_NoReportWithoutConnection) {
  controller.start();
  controller.clockPulse();
  EXPECT_TRUE(port.takeSent().empty());
}

/// @brief The cycle serves the link before it reads, also in the mode RC.
/// @verifies FR-35
/// @verifies FR-37
TEST_F(MainControllerTest, FR35_ServesTheLinkBeforeTheRead) {
  controller.start();
  port.arrive(pc.hello());
  controller.clockPulse();
  EXPECT_TRUE(scenario::welcomeOf(scenario::bodies(port.takeSent()).at(0)).has_value());
}

/// @brief When the PC sends without a pause at 115200 baud, the serial line transfers 1152 bytes in
/// each cycle. No frame is lost.
/// @verifies FR-35
/// @verifies FR-37
TEST_F(MainControllerTest, FR37_FullLineCostsNoFrame) {
  constexpr std::size_t kBytesPerCycle = 115'200 / 10 / 10;  // 10 bits in a byte, 10 cycles in 1 s
  connect();
  controller.start();
  scenario::Bytes line;
  std::size_t sent = 0;
  for (int cycle = 0; cycle < 100; ++cycle) {
    for (; line.size() < kBytesPerCycle; ++sent) {
      const scenario::Bytes frame = pc.order({.id = static_cast<std::uint16_t>(sent)});
      line.insert(line.end(), frame.begin(), frame.end());
    }
    port.arrive(std::span(line).first(kBytesPerCycle));
    line.erase(line.begin(), line.begin() + kBytesPerCycle);
    time.advance(milliseconds(100));
    controller.clockPulse();
    ASSERT_TRUE(scenario::reportOf(scenario::bodies(port.takeSent()).back()));
  }
  EXPECT_GT(sent, 4000U);
  EXPECT_EQ(connection.counts(), LinkCounts());
  EXPECT_EQ(pcReader.readU16({.name = FieldName::OrderId}),
            static_cast<std::uint16_t>(line.empty() ? sent - 1 : sent - 2));
}

/// @brief The PC sends without a pause. If a cycle is late by one period, the buffer of the port
/// becomes full. The bytes that are lost are counted, and the connection continues.
/// @verifies FR-49
TEST_F(MainControllerTest, FR49_LateCycleOnAFullLineLosesBytesAndGoesOn) {
  connect();
  controller.start();
  scenario::Bytes line;
  while (line.size() < 2 * 1152) {
    const scenario::Bytes frame = pc.keepAlive();
    line.insert(line.end(), frame.begin(), frame.end());
  }
  port.arrive(line);
  controller.clockPulse();
  EXPECT_EQ(connection.counts().lostBytes, line.size() - host::HostSerialPort::kReceived);
  const LinkCounts before = connection.counts();
  port.arrive(scenario::Bytes{0});
  port.arrive(pc.keepAlive());
  controller.clockPulse();
  EXPECT_TRUE(connection.connected());
  EXPECT_EQ(connection.counts().sequenceGaps, before.sequenceGaps + 1);
}

/// @brief A clock pulse during a cycle is an overrun of this cycle. One more cycle follows.
/// @verifies FR-4
TEST_F(MainControllerTest, FR4_PulseDuringACycleIsAnOverrun) {
  connect();
  controller.start();
  int late = 1;
  system.work = [&] {
    if (late > 0) {
      --late;
      controller.clockPulse();
    }
  };
  controller.clockPulse();
  const std::vector<scenario::Bytes> sent = scenario::bodies(port.takeSent());
  ASSERT_EQ(sent.size(), 2U);
  EXPECT_TRUE(scenario::reportOf(sent[0])->overran());
  EXPECT_FALSE(scenario::reportOf(sent[1])->overran());
  EXPECT_EQ(scenario::reportOf(sent[1])->overruns, 1);
}

/// @brief If two clock pulses occur during a cycle, they count as one overrun.
/// @verifies FR-4
TEST_F(MainControllerTest, FR4_CycleOverrunsOnce) {
  connect();
  controller.start();
  int late = 2;
  system.work = [&] {
    while (late > 0) {
      --late;
      controller.clockPulse();
    }
  };
  controller.clockPulse();
  const std::vector<scenario::Bytes> sent = scenario::bodies(port.takeSent());
  ASSERT_EQ(sent.size(), 2U);
  EXPECT_EQ(scenario::reportOf(sent[1])->overruns, 1);
}

/// @brief After more than 65535 lost clock pulses, a report still shows that its cycle overran.
/// @verifies FR-4
TEST_F(MainControllerTest, FR4_AnOverrunIsReportedAfterAnyNumberOfOverruns) {
  connect();
  controller.start();
  int late = 65'600;
  system.work = [&] {
    while (late > 0) {
      --late;
      controller.clockPulse();
    }
  };
  controller.clockPulse();
  static_cast<void>(port.takeSent());
  late = 1;
  controller.clockPulse();
  const std::vector<scenario::Bytes> sent = scenario::bodies(port.takeSent());
  ASSERT_EQ(sent.size(), 2U);
  EXPECT_TRUE(scenario::reportOf(sent[0])->overran());
  EXPECT_FALSE(scenario::reportOf(sent[1])->overran());
  EXPECT_EQ(scenario::reportOf(sent[1])->overruns, 2);
}

/// @brief If a control system has not completed a cycle, the cycle is an overrun.
/// @verifies FR-5
TEST_F(MainControllerTest, FR5_IncompleteControlSystemIsAnOverrun) {
  connect();
  controller.start();
  system.completes = false;
  controller.clockPulse();
  EXPECT_TRUE(sentReport().overran());
}

/// @brief Each completed cycle refreshes the watchdog once. The passing of time does not refresh
/// it.
/// @verifies FR-74
TEST_F(MainControllerTest, FR74_CompletedCycleRefreshesTheWatchdogOnce) {
  controller.start();
  EXPECT_EQ(watchdog.refreshes(), 0U);
  for (std::uint32_t cycle = 1; cycle <= 20; ++cycle) {
    time.advance(milliseconds(100));
    controller.clockPulse();
    EXPECT_EQ(watchdog.refreshes(), cycle);
  }
  EXPECT_FALSE(watchdog.missed());
}

/// @brief Before the start of the controller, neither a clock pulse nor the steps of a cycle
/// refresh the watchdog.
/// @verifies FR-74
TEST_F(MainControllerTest, FR74_NoRefreshBeforeTheStart) {
  controller.clockPulse();
  controller.read();
  controller.control();
  controller.write();
  EXPECT_EQ(watchdog.refreshes(), 0U);
}

/// @brief The watchdog is refreshed after the report, at the end of the cycle.
/// @verifies FR-74
TEST_F(MainControllerTest, FR74_RefreshIsTheLastStep) {
  state.atWrite = [this] { EXPECT_EQ(watchdog.refreshes(), 0U); };
  controller.start();
  controller.clockPulse();
  EXPECT_EQ(state.steps.back(), "write");
  EXPECT_EQ(watchdog.refreshes(), 1U);
}

/// @brief If a control system does not complete its work in a cycle, the cycle does not refresh the
/// watchdog. Three successive cycles without a refresh cause a reset.
/// @verifies FR-74
TEST_F(MainControllerTest, FR74_IncompleteCycleDoesNotRefresh) {
  controller.start();
  controller.clockPulse();
  system.completes = false;
  for (int cycle = 0; cycle < 3; ++cycle) {
    EXPECT_FALSE(watchdog.missed());
    time.advance(milliseconds(100));
    controller.clockPulse();
  }
  EXPECT_EQ(watchdog.refreshes(), 1U);
  EXPECT_TRUE(watchdog.missed());
}

/// @brief The watchdog is not refreshed if one of several control systems does not complete its
/// work.
/// @verifies FR-74
TEST_F(MainControllerTest, FR74_EachControlSystemMustComplete) {
  SpySystem another;
  systems.add(another);
  another.completes = false;
  controller.start();
  controller.clockPulse();
  EXPECT_EQ(watchdog.refreshes(), 0U);
  another.completes = true;
  controller.clockPulse();
  EXPECT_EQ(watchdog.refreshes(), 1U);
}

/// @brief Three kinds of cycles count as completed and refresh the watchdog: a cycle with a stop, a
/// cycle during which the next clock pulse occurs, and a cycle without a connection.
/// @verifies FR-74
TEST_F(MainControllerTest, FR74_StopAndOverrunCompleteTheirCycle) {
  controller.start();
  first.stop = true;
  controller.clockPulse();
  EXPECT_EQ(watchdog.refreshes(), 1U);
  bool late = true;
  system.work = [&] {
    if (std::exchange(late, false)) {
      controller.clockPulse();
    }
  };
  controller.clockPulse();
  EXPECT_EQ(watchdog.refreshes(), 3U);
}

}  // namespace
}  // namespace wr::test
