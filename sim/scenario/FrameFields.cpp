#include "sim/scenario/FrameFields.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace wr {

namespace {

using Form = FrameField::Form;

constexpr std::size_t kHeader = 3;
constexpr std::size_t kWheels = 4;

void addWheels(std::vector<FrameField>& fields, const std::string& name, std::size_t offset,
               std::size_t step, Form form) {
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    fields.push_back({name + std::to_string(wheel), kReportType, offset + step * wheel, form});
  }
}

void addCounters(std::vector<FrameField>& fields) {
  std::size_t offset = 74;
  for (const char* name :
       {"overruns", "lost_bytes", "damaged", "too_long", "unknown_version", "unknown_type",
        "wrong_length", "out_of_range", "unexpected", "sequence_gaps", "reports_not_sent"}) {
    fields.push_back({name, kReportType, offset, Form::U16});
    offset += 2;
  }
}

void addWheelBits(std::vector<FrameField>& fields, const std::string& name, std::size_t offset) {
  for (unsigned wheel = 0; wheel < kWheels; ++wheel) {
    fields.push_back({name + std::to_string(wheel), kReportType, offset, Form::Bit, wheel});
  }
}

std::vector<FrameField> makeFields() {
  std::vector<FrameField> fields{
      {"session", kWelcomeType, 0, Form::U8},
      {"cycle_period_ms", kWelcomeType, 12, Form::U16},
      {"waiting_cycles", kWelcomeType, 14, Form::U8},
      {"reset_cause", kWelcomeType, 15, Form::U8},
      {"fault", kWelcomeType, 16, Form::U8},
      {"fault_number", kWelcomeType, 17, Form::U16},
      {"fault_address", kWelcomeType, 19, Form::U32},
      {"lowest_version", kWelcomeType, 23, Form::U8},
      {"highest_version", kWelcomeType, 24, Form::U8},
      {"schema_hash", kWelcomeType, 25, Form::U32},
      {"cycle", kReportType, 0, Form::U32},
      {"time_ms", kReportType, 4, Form::U32},
      {"state", kReportType, 8, Form::U8},
      {"mode", kReportType, 9, Form::U8},
      {"source", kReportType, 10, Form::U8},
      {"stop", kReportType, 11, Form::Bit, 0},
      {"order_read", kReportType, 11, Form::Bit, 1},
      {"held", kReportType, 11, Form::Bit, 2},
      {"overran", kReportType, 11, Form::Bit, 3},
      {"armed", kReportType, 11, Form::Bit, 4},
      {"order_id", kReportType, 12, Form::U16},
      {"steering_set_point", kReportType, 14, Form::I16},
  };
  addWheels(fields, "quantity", 16, 3, Form::U8);
  addWheels(fields, "set_point", 17, 3, Form::I16);
  fields.push_back({"steering", kReportType, 28, Form::I16});
  addWheels(fields, "velocity", 30, 8, Form::I16);
  addWheels(fields, "current", 32, 8, Form::I16);
  addWheels(fields, "position", 34, 8, Form::I32);
  fields.push_back({"measured", kReportType, 62, Form::U16});
  addWheels(fields, "tension", 64, 2, Form::I16);
  fields.push_back({"turn", kReportType, 72, Form::I8});
  fields.push_back({"applied", kReportType, 73, Form::U8});
  addCounters(fields);
  fields.push_back({"steering_state", kReportType, 96, Form::U8});
  fields.push_back({"left_end", kReportType, 97, Form::Bit, 0});
  fields.push_back({"right_end", kReportType, 97, Form::Bit, 1});
  addWheelBits(fields, "cut_off", 98);
  addWheelBits(fields, "blind", 99);
  addWheels(fields, "rejected_edges", 100, 2, Form::U16);
  fields.push_back({"report_cycles", kReportType, 108, Form::U32});
  fields.push_back({"awake_cycles", kReportType, 112, Form::U32});
  fields.push_back({"start_cycles", kReportType, 116, Form::U32});
  fields.push_back({"inhibit", kReportType, 120, Form::U8});
  fields.push_back({"stop_cause", kReportType, 121, Form::U8});
  fields.push_back({"stop_wheel", kReportType, 122, Form::U8});
  fields.push_back({"stop_sources", kReportType, 123, Form::U8});
  fields.push_back({"sent_at", kReportType, 124, Form::U32});
  fields.push_back({"stale_orders", kReportType, 128, Form::U16});
  return fields;
}

struct Word {
  std::string_view field;
  std::string_view word;
  std::int64_t number;
};

constexpr std::array<Word, 46> kWords{{
    {"state", "Working", 0},
    {"state", "Waiting", 1},
    {"state", "WaitingN", 2},
    {"state", "Reconnecting", 3},
    {"mode", "RC", 0},
    {"mode", "PC", 1},
    {"source", "RC", 0},
    {"source", "PC", 1},
    {"source", "nobody", 255},
    {"steering_state", "Off", 0},
    {"steering_state", "Holding", 1},
    {"steering_state", "Turning", 2},
    {"steering_state", "Fault", 3},
    {"inhibit", "None", 0},
    {"inhibit", "NoOrder", 1},
    {"inhibit", "Stop", 2},
    {"inhibit", "NotArmed", 3},
    {"inhibit", "ProtectiveStop", 4},
    {"stop_cause", "None", 0},
    {"stop_cause", "EmergencyStop", 1},
    {"stop_cause", "SteeringFault", 2},
    {"stop_cause", "Overcurrent", 3},
    {"stop_cause", "NoMotion", 4},
    {"stop_cause", "WrongDirection", 5},
    {"stop_cause", "Overspeed", 6},
    {"stop_cause", "Tracking", 7},
    {"stop_cause", "MissingMeasurement", 8},
    {"stop_cause", "HallSignals", 9},
    {"stop_cause", "Reversal", 10},
    {"reset_cause", "Unknown", 0},
    {"reset_cause", "PowerOn", 1},
    {"reset_cause", "LowVoltage", 2},
    {"reset_cause", "Pin", 3},
    {"reset_cause", "Watchdog", 4},
    {"reset_cause", "ClockLost", 5},
    {"reset_cause", "Lockup", 6},
    {"reset_cause", "Software", 7},
    {"reset_cause", "Debugger", 8},
    {"fault", "None", 0},
    {"fault", "Assertion", 1},
    {"fault", "HardFault", 2},
    {"fault", "MemoryFault", 3},
    {"fault", "BusFault", 4},
    {"fault", "UsageFault", 5},
    {"fault", "UnexpectedInterrupt", 6},
    {"fault", "ClockFailed", 7},
}};

std::uint32_t unsignedAt(const Bytes& body, std::size_t offset, std::size_t size) {
  std::uint32_t value = 0;
  for (std::size_t i = size; i-- > 0;) {
    value = value << 8U | body.at(kHeader + offset + i);
  }
  return value;
}

}  // namespace

const std::vector<FrameField>& frameFields() {
  static const std::vector<FrameField> fields = makeFields();
  return fields;
}

const FrameField* findField(std::string_view name) {
  const std::vector<FrameField>& fields = frameFields();
  const auto found = std::ranges::find(fields, name, &FrameField::name);
  return found != fields.end() ? &*found : nullptr;
}

std::int64_t valueOf(const Bytes& body, const FrameField& field) {
  switch (field.form) {
    case Form::U8:
      return unsignedAt(body, field.offset, 1);
    case Form::I8:
      return static_cast<std::int8_t>(unsignedAt(body, field.offset, 1));
    case Form::U16:
      return unsignedAt(body, field.offset, 2);
    case Form::I16:
      return static_cast<std::int16_t>(unsignedAt(body, field.offset, 2));
    case Form::U32:
      return unsignedAt(body, field.offset, 4);
    case Form::I32:
      return static_cast<std::int32_t>(unsignedAt(body, field.offset, 4));
    case Form::Bit:
      return unsignedAt(body, field.offset, 1) >> field.bit & 1U;
  }
  return 0;
}

std::optional<std::int64_t> numberOf(const FrameField& field, std::string_view word) {
  for (const Word& known : kWords) {
    if (known.field == field.name && known.word == word) {
      return known.number;
    }
  }
  if (field.form == Form::Bit && (word == "yes" || word == "no")) {
    return word == "yes" ? 1 : 0;
  }
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc() || end != word.data() + word.size()) {
    return std::nullopt;
  }
  return number;
}

}  // namespace wr
