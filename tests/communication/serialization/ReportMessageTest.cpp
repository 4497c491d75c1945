#include "communication/serialization/ReportMessage.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "communication/serialization/SerialWriter.hpp"
#include "sim/scenario/FrameTable.hpp"
#include "support/LineBytes.hpp"
#include "support/difference.hpp"
#include "support/seed.hpp"

namespace wr {
namespace {

using test::Bytes;

Bytes written(const ReportData& data) {
  SerialWriter writer;
  EXPECT_TRUE(ReportMessage(data).writeTo(writer));
  return {writer.bytes().begin(), writer.bytes().end()};
}

unsigned u16(const Bytes& bytes, std::size_t offset) {
  return bytes[offset] + 256U * bytes[offset + 1];
}

/// @brief Returns a random number. The number is often one of the limits of its type.
template <class Number>
Number number(std::mt19937& random) {
  switch (random() % 4) {
    case 0:
      return std::numeric_limits<Number>::min();
    case 1:
      return std::numeric_limits<Number>::max();
    default:
      return static_cast<Number>(random());
  }
}

ReportData randomData(std::mt19937& random) {
  const auto flip = [&] { return random() % 2 == 0; };
  ReportData data;
  data.cycle = number<std::uint32_t>(random);
  data.time = Instant(1000ULL * number<std::uint32_t>(random));
  data.operationState = static_cast<std::uint8_t>(random() % 4);
  data.readingMode = static_cast<std::uint8_t>(random() % 2);
  data.source = static_cast<std::uint8_t>(random() % 2);
  data.stopSources = number<std::uint8_t>(random);
  data.orderRead = flip();
  data.held = flip();
  data.overran = flip();
  data.setPoints.orderId = number<std::uint16_t>(random);
  data.setPoints.sentAt = number<std::uint32_t>(random);
  data.setPoints.steering = Angle(number<std::int16_t>(random));
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    data.setPoints.wheels[wheel] = {static_cast<WheelQuantity>(random() % 3),
                                    number<std::int16_t>(random)};
    WheelMeasurements& measured = data.measurements.wheels[wheel];
    if (flip()) {
      measured.velocity = Velocity(number<std::int16_t>(random));
    }
    if (flip()) {
      measured.current = Current(number<std::int16_t>(random));
    }
    if (flip()) {
      measured.position = HallCount(number<std::int32_t>(random));
    }
    measured.cutOff = flip();
    measured.blind = flip();
    measured.rejectedEdges = number<std::uint16_t>(random);
    if (flip()) {
      data.outputs.tensions[wheel] = Tension(number<std::int16_t>(random));
    }
  }
  if (flip()) {
    data.measurements.steering = Angle(number<std::int16_t>(random));
  }
  data.measurements.steeringState = static_cast<SteeringState>(random() % 4);
  data.measurements.leftEnd = flip();
  data.measurements.rightEnd = flip();
  data.measurements.protection = {.inhibit = static_cast<Inhibit>(random() % 5),
                                  .cause = static_cast<StopCause>(random() % 11),
                                  .wheel = number<std::uint8_t>(random),
                                  .armed = flip()};
  if (flip()) {
    data.outputs.turn = static_cast<std::int8_t>(static_cast<int>(random() % 3) - 1);
  }
  data.overruns = number<std::uint16_t>(random);
  for (auto* count : {&data.link.lostBytes, &data.link.damaged, &data.link.tooLong,
                      &data.link.unknownVersion, &data.link.unknownType, &data.link.wrongLength,
                      &data.link.outOfRange, &data.link.unexpected, &data.link.sequenceGaps,
                      &data.link.reportsNotSent, &data.link.staleOrders}) {
    *count = number<std::uint16_t>(random);
  }
  for (auto* cost : {&data.costs.report, &data.costs.awake, &data.costs.start}) {
    *cost = number<std::uint32_t>(random);
  }
  return data;
}

/// @brief Returns the payload of a report. Builds this payload with the frame table, without the
/// code under test.
Bytes expected(const ReportData& data) {
  const Measurements& measured = data.measurements;
  const Protection& protection = measured.protection;
  const auto bit = [](bool set, std::size_t number) { return set ? 1U << number : 0U; };
  const auto i16 = [](auto value) { return static_cast<std::int16_t>(value ? value->count() : 0); };
  unsigned flags = bit(data.stopSources != 0, 0) | bit(data.orderRead, 1) | bit(data.held, 2);
  flags |= bit(data.overran, 3) | bit(protection.armed, 4);
  unsigned valid = bit(measured.steering.has_value(), 12);
  unsigned applied = bit(data.outputs.turn.has_value(), 4);
  unsigned cutOffs = 0;
  unsigned blind = 0;
  scenario::ReportPayload payload;
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    const WheelMeasurements& values = measured.wheels[wheel];
    const WheelSetPoint& setPoint = data.setPoints.wheels[wheel];
    payload.quantity[wheel] = static_cast<std::uint8_t>(setPoint.quantity);
    payload.setPoint[wheel] = setPoint.value;
    payload.velocity[wheel] = i16(values.velocity);
    payload.current[wheel] = i16(values.current);
    payload.position[wheel] = values.position.value_or(HallCount()).count();
    payload.rejectedEdges[wheel] = static_cast<std::uint16_t>(values.rejectedEdges);
    payload.tension[wheel] = i16(data.outputs.tensions[wheel]);
    valid |= bit(values.velocity.has_value(), 3 * wheel);
    valid |= bit(values.current.has_value(), 3 * wheel + 1);
    valid |= bit(values.position.has_value(), 3 * wheel + 2);
    applied |= bit(data.outputs.tensions[wheel].has_value(), wheel);
    cutOffs |= bit(values.cutOff, wheel);
    blind |= bit(values.blind, wheel);
  }
  payload.cycle = data.cycle;
  payload.timeMs = static_cast<std::uint32_t>(data.time.sinceStart() / 1000);
  payload.state = data.operationState;
  payload.mode = data.readingMode;
  payload.source = data.source;
  payload.flags = static_cast<std::uint8_t>(flags);
  payload.orderId = data.setPoints.orderId;
  payload.steeringSetPoint = static_cast<std::int16_t>(data.setPoints.steering.count());
  payload.steering = i16(measured.steering);
  payload.measured = static_cast<std::uint16_t>(valid);
  payload.turn = data.outputs.turn.value_or(0);
  payload.applied = static_cast<std::uint8_t>(applied);
  payload.overruns = data.overruns;
  payload.lostBytes = data.link.lostBytes;
  payload.damaged = data.link.damaged;
  payload.tooLong = data.link.tooLong;
  payload.unknownVersion = data.link.unknownVersion;
  payload.unknownType = data.link.unknownType;
  payload.wrongLength = data.link.wrongLength;
  payload.outOfRange = data.link.outOfRange;
  payload.unexpected = data.link.unexpected;
  payload.sequenceGaps = data.link.sequenceGaps;
  payload.reportsNotSent = data.link.reportsNotSent;
  payload.steeringState = static_cast<std::uint8_t>(measured.steeringState);
  payload.steeringEnds =
      static_cast<std::uint8_t>(bit(measured.leftEnd, 0) | bit(measured.rightEnd, 1));
  payload.cutOffs = static_cast<std::uint8_t>(cutOffs);
  payload.blindWheels = static_cast<std::uint8_t>(blind);
  payload.reportCycles = data.costs.report;
  payload.awakeCycles = data.costs.awake;
  payload.startCycles = data.costs.start;
  payload.inhibit = static_cast<std::uint8_t>(protection.inhibit);
  payload.stopCause = static_cast<std::uint8_t>(protection.cause);
  payload.stopWheel = protection.wheel;
  payload.stopSources = data.stopSources;
  payload.sentAt = data.setPoints.sentAt;
  payload.staleOrders = data.link.staleOrders;
  return payload.bytes();
}

/// @brief Two reports are equal only when all their values are equal.
TEST(ReportData, DiffersInEachValue) {
  SetPoints setPoints;
  setPoints.orderId = 1;
  Measurements measurements;
  measurements.steering = Angle(0);
  Outputs outputs;
  outputs.turn = 0;
  LinkCounts link;
  link.damaged = 1;
  constexpr CycleCosts kCosts{.awake = 1};
  test::expectDifference(
      &ReportData::cycle, 1U, &ReportData::time, Instant(1), &ReportData::operationState,
      std::uint8_t{1}, &ReportData::readingMode, std::uint8_t{1}, &ReportData::source,
      std::uint8_t{1}, &ReportData::stopSources, std::uint8_t{1}, &ReportData::orderRead, true,
      &ReportData::held, true, &ReportData::overran, true, &ReportData::setPoints, setPoints,
      &ReportData::measurements, measurements, &ReportData::outputs, outputs, &ReportData::overruns,
      std::uint16_t{1}, &ReportData::link, link, &ReportData::costs, kCosts);
}

/// @brief Two sets of link counts are equal only when all their counts are equal.
TEST(LinkCounts, DifferInEachCount) {
  constexpr std::uint16_t kOne = 1;
  test::expectDifference(
      &LinkCounts::lostBytes, kOne, &LinkCounts::damaged, kOne, &LinkCounts::tooLong, kOne,
      &LinkCounts::unknownVersion, kOne, &LinkCounts::unknownType, kOne, &LinkCounts::wrongLength,
      kOne, &LinkCounts::outOfRange, kOne, &LinkCounts::unexpected, kOne, &LinkCounts::sequenceGaps,
      kOne, &LinkCounts::reportsNotSent, kOne, &LinkCounts::staleOrders, kOne);
}

/// @brief Two cycle costs are equal only when all their counts are equal.
TEST(CycleCosts, DifferInEachCount) {
  test::expectDifference(&CycleCosts::report, 1U, &CycleCosts::awake, 1U, &CycleCosts::start, 1U);
}

/// @brief In a report without content, all measured and applied values are marked as missing.
/// @verifies FR-62
TEST(ReportMessage, FR62_AnEmptyReportMarksAllValuesAsMissing) {
  const scenario::ReportPayload empty{.source = 255, .stopWheel = 255};
  EXPECT_EQ(written({}), empty.bytes());
}

/// @brief Each measured and applied value has a separate validity bit and a separate position in
/// the report.
/// @verifies FR-62
TEST(ReportMessage, FR62_EachValueHasItsBitAndItsPlace) {
  struct Case {
    std::size_t place;
    unsigned measured;
    unsigned applied;
    ReportData data;
  };
  std::vector<Case> cases;
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    ReportData data;
    data.measurements.wheels[wheel].velocity = Velocity(0x1234);
    cases.push_back({30 + 8 * wheel, 1U << (3 * wheel), 0, data});
    data = {};
    data.measurements.wheels[wheel].current = Current(0x1234);
    cases.push_back({32 + 8 * wheel, 1U << (3 * wheel + 1), 0, data});
    data = {};
    data.measurements.wheels[wheel].position = HallCount(0x1234);
    cases.push_back({34 + 8 * wheel, 1U << (3 * wheel + 2), 0, data});
    data = {};
    data.outputs.tensions[wheel] = Tension(0x1234);
    cases.push_back({64 + 2 * wheel, 0, 1U << wheel, data});
  }
  ReportData data;
  data.measurements.steering = Angle(0x1234);
  cases.push_back({28, 1U << 12U, 0, data});
  for (const Case& one : cases) {
    const Bytes bytes = written(one.data);
    EXPECT_EQ(u16(bytes, one.place), 0x1234U);
    EXPECT_EQ(u16(bytes, 62), one.measured);
    EXPECT_EQ(bytes[73], one.applied);
    EXPECT_EQ(bytes[98], 0) << "setting a value must not report an overcurrent trip";
    EXPECT_EQ(bytes[99], 0) << "setting a value must not report missing motion feedback";
  }
}

/// @brief If the turn direction is missing, 0 is written.
/// @verifies FR-62
TEST(ReportMessage, FR62_AMissingTurnDirectionIsZero) {
  const Bytes bytes = written({});
  EXPECT_EQ(bytes[72], 0);
  EXPECT_EQ(bytes[73], 0);
}

/// @brief The turn direction is -1, 0 or 1. Its validity bit is also set when the direction is 0.
/// @verifies FR-62
TEST(ReportMessage, FR62_TheTurnDirectionHasItsBit) {
  for (const int turn : {-1, 0, 1}) {
    ReportData data;
    data.outputs.turn = static_cast<std::int8_t>(turn);
    const Bytes bytes = written(data);
    EXPECT_EQ(static_cast<std::int8_t>(bytes[72]), turn);
    EXPECT_EQ(bytes[73], 0x10);
  }
}

/// @brief Each flag has a separate bit in the report.
/// @verifies FR-4
/// @verifies FR-175
/// @verifies FR-305
/// @verifies FR-306
TEST(ReportMessage, FR175_EachFlagHasItsBit) {
  const std::vector<std::pair<bool ReportData::*, int>> flags{
      {&ReportData::orderRead, 2}, {&ReportData::held, 4}, {&ReportData::overran, 8}};
  for (const auto& [flag, bit] : flags) {
    ReportData data;
    data.*flag = true;
    EXPECT_EQ(written(data)[11], bit);
  }
  EXPECT_EQ(written({.stopSources = 4})[11], 1);
  ReportData armed;
  armed.measurements.protection.armed = true;
  EXPECT_EQ(written(armed)[11], 16);
}

/// @brief Four bytes contain the reason why the robot does not follow its set-points, the cause of
/// a protective stop, the wheel that caused this stop, and the sources that order a stop.
/// @verifies FR-242
TEST(ReportMessage, FR242_TheReasonWhyTheRobotDoesNotFollowHasItsPlace) {
  ReportData data;
  data.measurements.protection = {
      .inhibit = Inhibit::ProtectiveStop, .cause = StopCause::HallSignals, .wheel = 3};
  data.stopSources = 0x02;
  const Bytes bytes = written(data);
  EXPECT_EQ(Bytes(bytes.begin() + 120, bytes.begin() + 124), (Bytes{4, 9, 3, 2}));
  EXPECT_EQ(u16(bytes, 62), 0U) << "the cause of a stop must not count as a measured value";
}

/// @brief The order in force contains a time of the sender's clock. The report has a field for this
/// time.
/// @verifies FR-249
TEST(ReportMessage, FR249_TheTimeOfTheSenderHasItsPlace) {
  ReportData data;
  data.setPoints.sentAt = 0x04030201;
  const Bytes bytes = written(data);
  EXPECT_EQ(Bytes(bytes.begin() + 124, bytes.begin() + 128), (Bytes{1, 2, 3, 4}));
}

/// @brief Each count of the link has a separate position in the report.
/// @verifies FR-63
/// @verifies FR-243
TEST(ReportMessage, FR63_EachCountHasItsPlace) {
  ReportData data;
  data.overruns = 1;
  data.link = {.lostBytes = 2,
               .damaged = 3,
               .tooLong = 4,
               .unknownVersion = 5,
               .unknownType = 6,
               .wrongLength = 7,
               .outOfRange = 8,
               .unexpected = 9,
               .sequenceGaps = 10,
               .reportsNotSent = 11,
               .staleOrders = 12};
  const Bytes bytes = written(data);
  for (unsigned i = 0; i <= 10; ++i) {
    EXPECT_EQ(u16(bytes, 74 + 2 * i), i + 1);
  }
  EXPECT_EQ(u16(bytes, 128), 12U);
}

/// @brief The report contains the number of the steering state.
/// @verifies FR-65
TEST(ReportMessage, FR65_TheStateOfTheSteeringHasItsNumber) {
  using enum SteeringState;
  const std::vector<std::pair<SteeringState, int>> numbers{
      {Off, 0}, {Holding, 1}, {Turning, 2}, {Fault, 3}};
  for (const auto& [state, number] : numbers) {
    ReportData data;
    data.measurements.steeringState = state;
    EXPECT_EQ(written(data)[96], number);
  }
}

/// @brief Each end stop of the steering has a separate bit in the report.
/// @verifies FR-66
TEST(ReportMessage, FR66_EachEndStopHasItsBit) {
  ReportData data;
  data.measurements.leftEnd = true;
  EXPECT_EQ(written(data)[97], 1);
  data.measurements.rightEnd = true;
  EXPECT_EQ(written(data)[97], 3);
  data.measurements.leftEnd = false;
  EXPECT_EQ(written(data)[97], 2);
}

/// @brief Each wheel has a bit that is set when the overcurrent trip of this wheel has acted.
/// @verifies FR-67
TEST(ReportMessage, FR67_EachWheelThatIsCutOffHasItsBit) {
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    ReportData data;
    data.measurements.wheels[wheel].cutOff = true;
    EXPECT_EQ(written(data)[98], 1 << wheel);
    EXPECT_EQ(written(data)[99], 0);
  }
}

/// @brief Each wheel has a bit that is set when this wheel has no motion feedback.
/// @verifies FR-68
TEST(ReportMessage, FR68_EachBlindWheelHasItsBit) {
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    ReportData data;
    data.measurements.wheels[wheel].blind = true;
    EXPECT_EQ(written(data)[98], 0);
    EXPECT_EQ(written(data)[99], 1 << wheel);
  }
}

/// @brief The count of rejected Hall edges of each wheel has a separate position in the report.
/// @verifies FR-69
TEST(ReportMessage, FR69_EachCountOfRejectedEdgesHasItsPlace) {
  ReportData data;
  for (std::uint16_t wheel = 0; wheel < kWheelCount; ++wheel) {
    data.measurements.wheels[wheel].rejectedEdges = static_cast<std::uint16_t>(0xFFFF - wheel);
  }
  const Bytes bytes = written(data);
  for (unsigned wheel = 0; wheel < kWheelCount; ++wheel) {
    EXPECT_EQ(u16(bytes, 100 + 2 * wheel), 0xFFFFU - wheel);
  }
}

/// @brief The count of rejected Hall edges in the report stops at 65535.
/// @verifies FR-69
TEST(ReportMessage, FR69_TheCountOfRejectedEdgesStops) {
  ReportData data;
  data.measurements.wheels[1].rejectedEdges = 0x1'0003;
  data.measurements.wheels[2].rejectedEdges = 0xFFFF'FFFF;
  const Bytes bytes = written(data);
  EXPECT_EQ(u16(bytes, 102), 0xFFFFU);
  EXPECT_EQ(u16(bytes, 104), 0xFFFFU);
}

/// @brief Each count of processor cycles has a separate 32-bit field in the report.
/// @verifies FR-160
/// @verifies FR-302
/// @verifies FR-303
TEST(ReportMessage, FR160_EachCountOfCyclesHasItsPlace) {
  const Bytes bytes =
      written({.costs = {.report = 0x04030201, .awake = 0x08070605, .start = 0x0C0B0A09}});
  const Bytes costs(bytes.begin() + 108, bytes.begin() + 120);
  EXPECT_EQ(costs, (Bytes{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));
}

/// @brief If a value is out of the range of its field, the nearest value in the range is sent.
/// @verifies FR-177
TEST(ReportMessage, ValuesAreLimitedToTheirFields) {
  ReportData data;
  data.measurements.wheels[0].velocity = Velocity(40000);
  data.measurements.wheels[0].current = Current(-40000);
  data.measurements.steering = Angle(-32769);
  data.setPoints.steering = Angle(32768);
  data.outputs.tensions[0] = Tension(32769);
  const Bytes bytes = written(data);
  EXPECT_EQ(u16(bytes, 30), 0x7FFFU);
  EXPECT_EQ(u16(bytes, 32), 0x8000U);
  EXPECT_EQ(u16(bytes, 28), 0x8000U);
  EXPECT_EQ(u16(bytes, 14), 0x7FFFU);
  EXPECT_EQ(u16(bytes, 64), 0x7FFFU);
}

/// @brief For any data, each field of the report has the value, the position and the size that the
/// frame table demands.
/// @verifies FR-61
/// @verifies FR-62
/// @verifies FR-63
/// @verifies FR-65
/// @verifies FR-66
/// @verifies FR-67
/// @verifies FR-68
/// @verifies FR-69
/// @verifies FR-160
/// @verifies FR-302
/// @verifies FR-303
/// @verifies FR-170
TEST(ReportMessage, FR61_EachFieldIsWrittenAsInTheTable) {
  std::mt19937 random(test::seed());
  for (int i = 0; i < 1000; ++i) {
    const ReportData data = randomData(random);
    ASSERT_EQ(written(data), expected(data));
  }
}

/// @brief The writer returns false when there is no space for a report.
/// @verifies FR-64
TEST(ReportMessage, AReportWithoutRoomIsTold) {
  SerialWriter writer;
  const ReportData data;
  ASSERT_TRUE(ReportMessage(data).writeTo(writer));
  EXPECT_FALSE(ReportMessage(data).writeTo(writer));
}

}  // namespace
}  // namespace wr
