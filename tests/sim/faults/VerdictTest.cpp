#include "sim/faults/Verdict.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace wr::test {

namespace {

using faults::Observation;
using faults::Outcome;
using faults::Outputs;

constexpr int kWindow = 1000;  // ms
constexpr Outputs kDriving{.drive = {0.3F, 0.3F, 0.3F, 0.3F}, .steering = 5};
constexpr Outputs kOff{.drive = {}, .steering = 5};
constexpr Outputs kWrong{.drive = {0.9F, 0.3F, 0.3F, 0.3F}, .steering = 5};

/// Returns a run with a fault. The given outputs begin at a given time and last for a given
/// duration. The times are in ms.
Observation runWith(const Outputs& outputs, int from, int count) {
  Observation seen{.outputs = std::vector<Outputs>(kWindow, kDriving)};
  for (int ms = from; ms < from + count; ++ms) {
    seen.outputs.at(static_cast<std::size_t>(ms)) = outputs;
  }
  return seen;
}

faults::Verdict judge(const Observation& seen) {
  static const std::vector<Outputs> kReference(kWindow, kDriving);
  return faults::judge(seen, kReference.data());
}

}  // namespace

TEST(VerdictTest, EqualOutputsAreHarmless) {
  const auto verdict = judge(runWith(kDriving, 0, 0));
  EXPECT_EQ(verdict.outcome, Outcome::Harmless);
  EXPECT_EQ(verdict.wrongFor, 0);
}

TEST(VerdictTest, WrongOutputsThatNobodyReportsAreSilent) {
  const auto verdict = judge(runWith(kWrong, 100, 50));
  EXPECT_EQ(verdict.outcome, Outcome::Silent);
  EXPECT_EQ(verdict.wrongFor, 50);
}

TEST(VerdictTest, AWrongAngleIsAWrongOutput) {
  Outputs turned = kDriving;
  turned.steering += faults::kWrongAngle + 0.1F;
  EXPECT_EQ(judge(runWith(turned, 100, 50)).outcome, Outcome::Silent);
}

TEST(VerdictTest, AShortOrSmallDifferenceIsHarmless) {
  EXPECT_EQ(judge(runWith(kWrong, 100, faults::kShort)).outcome, Outcome::Harmless);
  EXPECT_EQ(judge(runWith(kWrong, 100, faults::kShort + 1)).outcome, Outcome::Silent);
  Outputs near = kDriving;
  near.drive[2] += 0.9F * faults::kWrongDrive;
  EXPECT_EQ(judge(runWith(near, 0, kWindow)).outcome, Outcome::Harmless);
}

TEST(VerdictTest, AReportInTimeIsADetection) {
  Observation seen = runWith(kWrong, 100, 500);
  seen.reportedAt = 100 + faults::kSafeWithin - 1;
  const auto verdict = judge(seen);
  EXPECT_EQ(verdict.outcome, Outcome::Detected);
  EXPECT_EQ(verdict.safeAfter, seen.reportedAt);
}

TEST(VerdictTest, AReportAfterTooLongIsLate) {
  Observation seen = runWith(kWrong, 100, 500);
  seen.reportedAt = 100 + faults::kSafeWithin;
  EXPECT_EQ(judge(seen).outcome, Outcome::Late);
}

TEST(VerdictTest, AResetThatSwitchesOffIsADetection) {
  Observation seen = runWith(kOff, 200, kWindow - 200);
  seen.resetAt = 199;
  EXPECT_EQ(judge(seen).outcome, Outcome::Detected);
}

TEST(VerdictTest, VoltageAfterAResetIsLate) {
  Observation seen = runWith(kOff, 200, kWindow - 201);
  seen.resetAt = 199;
  EXPECT_EQ(judge(seen).outcome, Outcome::Late);
}

TEST(VerdictTest, ASteeringThatTurnsAfterAResetIsLate) {
  Outputs turning = kOff;
  turning.steering += 2 * faults::kWrongAngle;
  Observation seen = runWith(kOff, 199, kWindow - 199);
  seen.outputs.back() = turning;
  seen.resetAt = 199;
  EXPECT_EQ(judge(seen).outcome, Outcome::Late);
}

TEST(VerdictTest, SilenceWithoutAResetIsAHang) {
  Observation seen = runWith(kDriving, 0, 0);
  seen.answers = false;
  EXPECT_EQ(judge(seen).outcome, Outcome::Hung);
}

}  // namespace wr::test
