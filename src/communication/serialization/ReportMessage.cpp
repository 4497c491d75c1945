#include "communication/serialization/ReportMessage.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>

namespace wr {

namespace {

constexpr std::uint32_t kStopFlag = 1;
constexpr std::uint32_t kOrderReadFlag = 2;
constexpr std::uint32_t kHeldFlag = 4;
constexpr std::uint32_t kOverranFlag = 8;
constexpr std::uint32_t kArmedFlag = 16;

constexpr std::uint64_t kMicrosecondsPerMillisecond = 1000;

// Validity bits: a bit is 0 if its value is missing, otherwise 1.
constexpr std::uint32_t velocityBit(std::size_t wheel) {
  return 1U << (3 * wheel);
}
constexpr std::uint32_t currentBit(std::size_t wheel) {
  return 2U << (3 * wheel);
}
constexpr std::uint32_t positionBit(std::size_t wheel) {
  return 4U << (3 * wheel);
}
constexpr std::uint32_t kSteeringBit = 1U << 12U;
constexpr std::uint32_t tensionBit(std::size_t wheel) {
  return 1U << wheel;
}
constexpr std::uint32_t kTurnBit = 1U << 4U;

constexpr std::uint32_t kLeftEndBit = 1;
constexpr std::uint32_t kRightEndBit = 2;

std::uint32_t bitIf(bool condition, std::uint32_t bit) {
  return condition ? bit : 0;
}

std::int16_t nearestI16(std::int32_t value) {
  using Limits = std::numeric_limits<std::int16_t>;
  return static_cast<std::int16_t>(std::clamp<std::int32_t>(value, Limits::min(), Limits::max()));
}

template <class Value>
std::int32_t countOrZero(const std::optional<Value>& value) {
  return value.value_or(Value()).count();
}

std::uint16_t measuredBits(const Measurements& measurements) {
  std::uint32_t bits = measurements.steering ? kSteeringBit : 0;
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    bits |= measurements.wheels[wheel].velocity ? velocityBit(wheel) : 0;
    bits |= measurements.wheels[wheel].current ? currentBit(wheel) : 0;
    bits |= measurements.wheels[wheel].position ? positionBit(wheel) : 0;
  }
  return static_cast<std::uint16_t>(bits);
}

std::uint8_t appliedBits(const Outputs& outputs) {
  std::uint32_t bits = outputs.turn ? kTurnBit : 0;
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    bits |= outputs.tensions[wheel] ? tensionBit(wheel) : 0;
  }
  return static_cast<std::uint8_t>(bits);
}

std::uint8_t flags(const ReportData& data) {
  return static_cast<std::uint8_t>(bitIf(data.stopSources != 0, kStopFlag) |
                                   bitIf(data.orderRead, kOrderReadFlag) |
                                   bitIf(data.held, kHeldFlag) | bitIf(data.overran, kOverranFlag) |
                                   bitIf(data.measurements.protection.armed, kArmedFlag));
}

void writeCycle(Writer& writer, const ReportData& data) {
  writer.writeU32({.name = FieldName::Cycle}, data.cycle);
  writer.writeU32({.name = FieldName::Time},
                  static_cast<std::uint32_t>(data.time.sinceStart() / kMicrosecondsPerMillisecond));
  writer.writeU8({.name = FieldName::OperationState}, data.operationState);
  writer.writeU8({.name = FieldName::ReadingMode}, data.readingMode);
  writer.writeU8({.name = FieldName::Source}, data.source);
  writer.writeU8({.name = FieldName::Flags}, flags(data));
}

void writeSetPoints(Writer& writer, const SetPoints& setPoints) {
  writer.writeU16({.name = FieldName::OrderId}, setPoints.orderId);
  writer.writeI16({.name = FieldName::Steering}, nearestI16(setPoints.steering.count()));
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    writer.writeU8({.name = FieldName::WheelQuantity},
                   static_cast<std::uint8_t>(setPoints.wheels[wheel].quantity));
    writer.writeI16({.name = FieldName::WheelValue}, setPoints.wheels[wheel].value);
  }
}

void writeMeasurements(Writer& writer, const Measurements& measurements) {
  writer.writeI16({.name = FieldName::SteeringPosition},
                  nearestI16(countOrZero(measurements.steering)));
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    const WheelMeasurements& measured = measurements.wheels[wheel];
    writer.writeI16({.name = FieldName::WheelVelocity}, nearestI16(countOrZero(measured.velocity)));
    writer.writeI16({.name = FieldName::WheelCurrent}, nearestI16(countOrZero(measured.current)));
    writer.writeI32({.name = FieldName::WheelPosition}, countOrZero(measured.position));
  }
  writer.writeU16({.name = FieldName::Measured}, measuredBits(measurements));
}

void writeOutputs(Writer& writer, const Outputs& outputs) {
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    writer.writeI16({.name = FieldName::WheelTension},
                    nearestI16(countOrZero(outputs.tensions[wheel])));
  }
  writer.writeU8({.name = FieldName::Turn}, static_cast<std::uint8_t>(outputs.turn.value_or(0)));
  writer.writeU8({.name = FieldName::Applied}, appliedBits(outputs));
}

struct CountField {
  FieldName name;
  std::uint16_t LinkCounts::*count;
};

constexpr std::array kCountFields{
    CountField{.name = FieldName::LostBytes, .count = &LinkCounts::lostBytes},
    CountField{.name = FieldName::Damaged, .count = &LinkCounts::damaged},
    CountField{.name = FieldName::TooLong, .count = &LinkCounts::tooLong},
    CountField{.name = FieldName::UnknownVersion, .count = &LinkCounts::unknownVersion},
    CountField{.name = FieldName::UnknownType, .count = &LinkCounts::unknownType},
    CountField{.name = FieldName::WrongLength, .count = &LinkCounts::wrongLength},
    CountField{.name = FieldName::OutOfRange, .count = &LinkCounts::outOfRange},
    CountField{.name = FieldName::Unexpected, .count = &LinkCounts::unexpected},
    CountField{.name = FieldName::SequenceGaps, .count = &LinkCounts::sequenceGaps},
    CountField{.name = FieldName::ReportsNotSent, .count = &LinkCounts::reportsNotSent},
};

void writeCounts(Writer& writer, const LinkCounts& counts) {
  // bound: 10
  for (const CountField& field : kCountFields) {
    writer.writeU16({.name = field.name}, counts.*field.count);
  }
}

// Returns one bit for each wheel: 1 if the member `mark` of this wheel is true.
std::uint8_t wheelBits(const Measurements& measurements, bool WheelMeasurements::*mark) {
  std::uint32_t bits = 0;
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    bits |= bitIf(measurements.wheels[wheel].*mark, 1U << wheel);
  }
  return static_cast<std::uint8_t>(bits);
}

void writeConditions(Writer& writer, const Measurements& measurements) {
  writer.writeU8({.name = FieldName::SteeringState},
                 static_cast<std::uint8_t>(measurements.steeringState));
  writer.writeU8({.name = FieldName::SteeringEnds},
                 static_cast<std::uint8_t>(bitIf(measurements.leftEnd, kLeftEndBit) |
                                           bitIf(measurements.rightEnd, kRightEndBit)));
  writer.writeU8({.name = FieldName::CutOffs}, wheelBits(measurements, &WheelMeasurements::cutOff));
  writer.writeU8({.name = FieldName::BlindWheels},
                 wheelBits(measurements, &WheelMeasurements::blind));
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    constexpr std::uint32_t kMaxCount = std::numeric_limits<std::uint16_t>::max();
    writer.writeU16(
        {.name = FieldName::RejectedEdges},
        static_cast<std::uint16_t>(std::min(measurements.wheels[wheel].rejectedEdges, kMaxCount)));
  }
}

void writeCosts(Writer& writer, const CycleCosts& costs) {
  writer.writeU32({.name = FieldName::ReportCost}, costs.report);
  writer.writeU32({.name = FieldName::AwakeCost}, costs.awake);
  writer.writeU32({.name = FieldName::StartCost}, costs.start);
}

void writeStop(Writer& writer, const ReportData& data) {
  const Protection& protection = data.measurements.protection;
  writer.writeU8({.name = FieldName::Inhibit}, static_cast<std::uint8_t>(protection.inhibit));
  writer.writeU8({.name = FieldName::StopCause}, static_cast<std::uint8_t>(protection.cause));
  writer.writeU8({.name = FieldName::StopWheel}, protection.wheel);
  writer.writeU8({.name = FieldName::StopSources}, data.stopSources);
}

}  // namespace

ReportMessage::ReportMessage(const ReportData& data) : data_(data) {}

bool ReportMessage::writeTo(Writer& writer) const {
  writeCycle(writer, data_);
  writeSetPoints(writer, data_.setPoints);
  writeMeasurements(writer, data_.measurements);
  writeOutputs(writer, data_.outputs);
  writer.writeU16({.name = FieldName::Overruns}, data_.overruns);
  writeCounts(writer, data_.link);
  writeConditions(writer, data_.measurements);
  writeCosts(writer, data_.costs);
  writeStop(writer, data_);
  writer.writeU32({.name = FieldName::SentAt}, data_.setPoints.sentAt);
  writer.writeU16({.name = FieldName::StaleOrders}, data_.link.staleOrders);
  return writer.finish();
}

}  // namespace wr
