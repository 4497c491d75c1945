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

// Validity bits: a bit is 1 if its value is not missing.
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

template <class Value>
std::optional<Value> validIf(bool valid, std::int32_t count) {
  return valid ? std::optional<Value>(Value(count)) : std::nullopt;
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

void readCycle(Reader& reader, ReportData& data) {
  data.cycle = reader.readU32({.name = FieldName::Cycle});
  data.time = Instant(reader.readU32({.name = FieldName::Time}) * kMicrosecondsPerMillisecond);
  data.operationState = reader.readU8({.name = FieldName::OperationState});
  data.readingMode = reader.readU8({.name = FieldName::ReadingMode});
  data.source = reader.readU8({.name = FieldName::Source});
  const std::uint32_t bits = reader.readU8({.name = FieldName::Flags});
  data.orderRead = (bits & kOrderReadFlag) != 0;
  data.held = (bits & kHeldFlag) != 0;
  data.overran = (bits & kOverranFlag) != 0;
  data.measurements.protection.armed = (bits & kArmedFlag) != 0;
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

void readSetPoints(Reader& reader, SetPoints& setPoints) {
  setPoints.orderId = reader.readU16({.name = FieldName::OrderId});
  setPoints.steering = Angle(reader.readI16({.name = FieldName::Steering}));
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    setPoints.wheels[wheel].quantity =
        static_cast<WheelQuantity>(reader.readU8({.name = FieldName::WheelQuantity}));
    setPoints.wheels[wheel].value = reader.readI16({.name = FieldName::WheelValue});
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

void readMeasurements(Reader& reader, Measurements& measurements) {
  struct Raw {
    std::int16_t velocity;
    std::int16_t current;
    std::int32_t position;
  };
  std::array<Raw, kWheelCount> raw{};
  const std::int16_t steering = reader.readI16({.name = FieldName::SteeringPosition});
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    raw[wheel].velocity = reader.readI16({.name = FieldName::WheelVelocity});
    raw[wheel].current = reader.readI16({.name = FieldName::WheelCurrent});
    raw[wheel].position = reader.readI32({.name = FieldName::WheelPosition});
  }
  const std::uint32_t bits = reader.readU16({.name = FieldName::Measured});
  measurements.steering = validIf<Angle>((bits & kSteeringBit) != 0, steering);
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    WheelMeasurements& measured = measurements.wheels[wheel];
    measured.velocity = validIf<Velocity>((bits & velocityBit(wheel)) != 0, raw[wheel].velocity);
    measured.current = validIf<Current>((bits & currentBit(wheel)) != 0, raw[wheel].current);
    measured.position = validIf<HallCount>((bits & positionBit(wheel)) != 0, raw[wheel].position);
  }
}

void writeOutputs(Writer& writer, const Outputs& outputs) {
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    writer.writeI16({.name = FieldName::WheelTension},
                    nearestI16(countOrZero(outputs.tensions[wheel])));
  }
  writer.writeU8({.name = FieldName::Turn}, static_cast<std::uint8_t>(outputs.turn.value_or(0)));
  writer.writeU8({.name = FieldName::Applied}, appliedBits(outputs));
}

void readOutputs(Reader& reader, Outputs& outputs) {
  std::array<std::int16_t, kWheelCount> tensions{};
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    tensions[wheel] = reader.readI16({.name = FieldName::WheelTension});
  }
  const auto turn = static_cast<std::int8_t>(reader.readU8({.name = FieldName::Turn}));
  const std::uint32_t bits = reader.readU8({.name = FieldName::Applied});
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    outputs.tensions[wheel] = validIf<Tension>((bits & tensionBit(wheel)) != 0, tensions[wheel]);
  }
  outputs.turn = (bits & kTurnBit) != 0 ? std::optional(turn) : std::nullopt;
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

void readCounts(Reader& reader, LinkCounts& counts) {
  for (const CountField& field : kCountFields) {
    counts.*field.count = reader.readU16({.name = field.name});
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

void setMarks(Measurements& measurements, bool WheelMeasurements::*mark, std::uint32_t bits) {
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    measurements.wheels[wheel].*mark = (bits & 1U << wheel) != 0;
  }
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

void readConditions(Reader& reader, Measurements& measurements) {
  measurements.steeringState =
      static_cast<SteeringState>(reader.readU8({.name = FieldName::SteeringState}));
  const std::uint32_t ends = reader.readU8({.name = FieldName::SteeringEnds});
  measurements.leftEnd = (ends & kLeftEndBit) != 0;
  measurements.rightEnd = (ends & kRightEndBit) != 0;
  setMarks(measurements, &WheelMeasurements::cutOff, reader.readU8({.name = FieldName::CutOffs}));
  setMarks(measurements, &WheelMeasurements::blind,
           reader.readU8({.name = FieldName::BlindWheels}));
  for (std::size_t wheel = 0; wheel < kWheelCount; ++wheel) {
    measurements.wheels[wheel].rejectedEdges = reader.readU16({.name = FieldName::RejectedEdges});
  }
}

void writeCosts(Writer& writer, const CycleCosts& costs) {
  writer.writeU32({.name = FieldName::ReportCost}, costs.report);
  writer.writeU32({.name = FieldName::AwakeCost}, costs.awake);
  writer.writeU32({.name = FieldName::StartCost}, costs.start);
}

void readCosts(Reader& reader, CycleCosts& costs) {
  costs.report = reader.readU32({.name = FieldName::ReportCost});
  costs.awake = reader.readU32({.name = FieldName::AwakeCost});
  costs.start = reader.readU32({.name = FieldName::StartCost});
}

void writeStop(Writer& writer, const ReportData& data) {
  const Protection& protection = data.measurements.protection;
  writer.writeU8({.name = FieldName::Inhibit}, static_cast<std::uint8_t>(protection.inhibit));
  writer.writeU8({.name = FieldName::StopCause}, static_cast<std::uint8_t>(protection.cause));
  writer.writeU8({.name = FieldName::StopWheel}, protection.wheel);
  writer.writeU8({.name = FieldName::StopSources}, data.stopSources);
}

void readStop(Reader& reader, ReportData& data) {
  Protection& protection = data.measurements.protection;
  protection.inhibit = static_cast<Inhibit>(reader.readU8({.name = FieldName::Inhibit}));
  protection.cause = static_cast<StopCause>(reader.readU8({.name = FieldName::StopCause}));
  protection.wheel = reader.readU8({.name = FieldName::StopWheel});
  data.stopSources = reader.readU8({.name = FieldName::StopSources});
}

}  // namespace

ReportMessage::ReportMessage(ReportData& data) : data_(data) {}

bool ReportMessage::readFrom(Reader& reader) {
  readCycle(reader, data_);
  readSetPoints(reader, data_.setPoints);
  readMeasurements(reader, data_.measurements);
  readOutputs(reader, data_.outputs);
  data_.overruns = reader.readU16({.name = FieldName::Overruns});
  readCounts(reader, data_.link);
  readConditions(reader, data_.measurements);
  readCosts(reader, data_.costs);
  readStop(reader, data_);
  data_.setPoints.sentAt = reader.readU32({.name = FieldName::SentAt});
  data_.link.staleOrders = reader.readU16({.name = FieldName::StaleOrders});
  return reader.finish();
}

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
