#include "main_control/ControlData.hpp"

#include <gtest/gtest.h>

namespace wr::test {
namespace {

class ControlDataTest : public testing::Test {
 protected:
  [[nodiscard]] ReportData report() {
    return data.report(OperationStateId::Waiting, ModeId::PC, {.damaged = 5});
  }

  ControlData data;
};

/// @brief Before the first cycle, there are no set-points, no measured values and no source. The
/// report shows that the robot is held.
/// @verifies FR-19
/// @verifies FR-174
TEST_F(ControlDataTest, BeginsEmpty) {
  ReportData expected{.operationState = 1, .readingMode = 1, .held = true, .link = {.damaged = 5}};
  expected.measurements.protection.inhibit = Inhibit::NoOrder;
  EXPECT_EQ(report(), expected);
  EXPECT_FALSE(data.setPoints().has_value());
}

/// @brief The source of an order becomes valid together with the set-points of this order.
/// @verifies FR-19
TEST_F(ControlDataTest, FR19_SourceTakesForceWithTheSetPoints) {
  data.saveModeId(ModeId::RC);
  EXPECT_EQ(report().source, ReportData::kNoSource);
  data.saveSetPoints({.orderId = 3});
  EXPECT_EQ(report().source, 0);
  data.saveModeId(ModeId::PC);
  EXPECT_EQ(report().source, 0);
  data.saveSetPoints({.orderId = 4});
  EXPECT_EQ(report().source, 1);
}

/// @brief The report contains all values that were saved in the cycle.
/// @verifies FR-61
/// @verifies FR-174
/// @verifies FR-175
/// @verifies FR-305
/// @verifies FR-306
TEST_F(ControlDataTest, FR61_ReportHoldsTheCycle) {
  data.beginCycle(Instant(123'456));
  data.saveModeId(ModeId::PC);
  data.saveSetPoints({.orderId = 9, .steering = Angle(-5)});
  data.saveStop(2);
  data.saveHeld(true);
  data.saveOverrun();
  data.measurements().steering = Angle(7);
  data.outputs().turn = std::int8_t{-1};
  const ReportData report = this->report();
  EXPECT_EQ(report.cycle, 1U);
  EXPECT_EQ(report.time, Instant(123'456));
  EXPECT_EQ(report.setPoints.orderId, 9);
  EXPECT_EQ(report.setPoints.steering, Angle(-5));
  EXPECT_TRUE(report.stopSources == 2 && report.held && report.overran && report.orderRead);
  EXPECT_EQ(report.overruns, 1);
  EXPECT_EQ(report.measurements.steering, Angle(7));
  EXPECT_EQ(report.outputs.turn, -1);
  EXPECT_EQ(report.link.damaged, 5);
}

/// @brief The next cycle keeps the set-points, their source and the count of overruns. It clears
/// the rest of the saved values.
/// @verifies FR-14
/// @verifies FR-62
TEST_F(ControlDataTest, FR62_NextCycleForgetsWhatWasMeasured) {
  data.beginCycle(Instant(1));
  data.saveModeId(ModeId::RC);
  data.saveSetPoints({.orderId = 9});
  data.saveStop(1);
  data.saveHeld(true);
  data.saveOverrun();
  data.measurements().steering = Angle(7);
  data.outputs().turn = std::int8_t{-1};
  data.beginCycle(Instant(2));
  const ReportData expected{.cycle = 2,
                            .time = Instant(2),
                            .operationState = 1,
                            .readingMode = 1,
                            .source = 0,
                            .setPoints = {.orderId = 9, .repeated = true},
                            .overruns = 1,
                            .link = {.damaged = 5}};
  EXPECT_EQ(report(), expected);
}

/// @brief While a source orders a stop, the report contains the stop as the reason for not
/// following the set-points, even if there are other reasons.
/// @verifies FR-242
/// @verifies FR-306
TEST_F(ControlDataTest, FR242_AStopIsTheFirstReason) {
  data.beginCycle(Instant(1));
  data.saveStop(1);
  data.measurements().protection.inhibit = Inhibit::ProtectiveStop;
  EXPECT_EQ(report().measurements.protection.inhibit, Inhibit::Stop);
  EXPECT_TRUE(report().held);
}

/// @brief Without set-points, and also in the state Reconnecting, the report contains this reason
/// for not following the set-points: no source sends orders.
/// @verifies FR-242
/// @verifies FR-306
TEST_F(ControlDataTest, FR242_WithoutOrdersTheReasonIsThatNobodyOrders) {
  data.beginCycle(Instant(1));
  EXPECT_EQ(report().measurements.protection.inhibit, Inhibit::NoOrder);
  EXPECT_TRUE(report().held);
  data.beginCycle(Instant(2));
  data.saveSetPoints({.orderId = 1});
  EXPECT_EQ(report().measurements.protection.inhibit, Inhibit::None);
  EXPECT_FALSE(report().held);
  data.beginCycle(Instant(3));
  const ReportData reconnecting = data.report(OperationStateId::Reconnecting, ModeId::RC, {});
  EXPECT_EQ(reconnecting.measurements.protection.inhibit, Inhibit::NoOrder);
  EXPECT_TRUE(reconnecting.held);
}

/// @brief The report contains three values of the safety functions: the reason for not following
/// the set-points, the cause of the protective stop, and the wheel that caused this stop. The
/// report also shows that the robot is held.
/// @verifies FR-242
/// @verifies FR-306
TEST_F(ControlDataTest, FR242_TheReasonOfASafetyFunctionIsReported) {
  data.beginCycle(Instant(1));
  data.saveSetPoints({.orderId = 1});
  const Protection protection{
      .inhibit = Inhibit::ProtectiveStop, .cause = StopCause::Overspeed, .wheel = 2, .armed = true};
  data.measurements().protection = protection;
  EXPECT_EQ(report().measurements.protection, protection);
  EXPECT_TRUE(report().held);
}

/// @brief The count of overruns stops at its greatest value.
/// @verifies FR-4
TEST_F(ControlDataTest, FR4_OverrunCountStopsAtItsGreatestValue) {
  for (int i = 0; i < 65'540; ++i) {
    data.saveOverrun();
  }
  EXPECT_EQ(report().overruns, 65'535);
}

/// @brief The report contains three counts of processor cycles. Each count is the difference
/// between two values of the cycle counter. The counter may overflow between these two values.
/// @verifies FR-160
/// @verifies FR-302
/// @verifies FR-303
TEST_F(ControlDataTest, FR160_CostsAreDifferences) {
  constexpr std::uint32_t kFirst = 0xFFFFFF00;  // the counter overflows to 0 in the first cycle
  data.beginCycle(Instant(1));
  data.saveStart(kFirst, kFirst + 7);
  EXPECT_EQ(report().costs, (CycleCosts{.report = 0, .awake = 0, .start = 7}));
  data.saveReported(kFirst + 1000);
  EXPECT_EQ(report().costs, (CycleCosts{.report = 0, .awake = 0, .start = 7}));
  data.beginCycle(Instant(2));
  data.saveStart(kFirst + 5000, kFirst + 5009);
  EXPECT_EQ(report().costs, (CycleCosts{.report = 1000, .awake = 5000, .start = 9}));
}

/// @brief If a cycle has sent no report, the next report contains 0 as the count of processor
/// cycles up to the previous report.
/// @verifies FR-160
TEST_F(ControlDataTest, FR160_NoCostWithoutReport) {
  data.saveReported(50);
  data.beginCycle(Instant(1));
  data.saveStart(100, 101);
  EXPECT_EQ(report().costs.report, 0U);
  data.saveReported(200);
  data.beginCycle(Instant(2));
  data.saveStart(300, 301);
  data.beginCycle(Instant(3));
  data.saveStart(500, 501);
  EXPECT_EQ(report().costs.report, 0U);
}

}  // namespace
}  // namespace wr::test
