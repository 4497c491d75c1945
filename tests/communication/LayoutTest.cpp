#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bluetooth/Bluetooth.hpp"
#include "communication/framing/Frame.hpp"
#include "communication/pc_connection/FirmwareIdentity.hpp"
#include "communication/serialization/OrderMessage.hpp"
#include "communication/serialization/ReportMessage.hpp"
#include "communication/serialization/SerialReader.hpp"
#include "main_control/operation_modes/Mode.hpp"
#include "main_control/operation_states/OperationState.hpp"
#include "services/StartRecord.hpp"
#include "services/SystemConstants.hpp"
#include "sim/scenario/FrameFields.hpp"
#include "sim/scenario/FrameTable.hpp"
#include "units/Measurements.hpp"
#include "units/SetPoints.hpp"
#include "warning/WaitingK.hpp"

namespace wr {
namespace {

/// @brief Returns the layout of all fields. The result has one text line for each field, with the
/// frame, name, type and offset of the field.
std::string schema() {
  std::string lines;
  for (const scenario::FrameRow& row : scenario::kFrameRows) {
    lines += std::string(row.frame) + ' ' + std::string(row.field) + ' ' + std::string(row.type) +
             ' ' + std::to_string(row.offset) + '\n';
  }
  return lines;
}

/// @brief Returns the CRC-32 of a text, with the algorithm of Ethernet and zlib. Computes one bit
/// at a time. The polynomial is 0x04C11DB7, in reflected form.
std::uint32_t crc32(const std::string& text) {
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char letter : text) {
    crc ^= static_cast<std::uint8_t>(letter);
    for (int bit = 0; bit < 8; ++bit) {
      crc = crc >> 1U ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
    }
  }
  return ~crc;
}

/// @brief A reader that records the type of each field.
class TypesReader final : public Reader {
 public:
  [[nodiscard]] bool available() const override { return true; }
  [[nodiscard]] bool stopOrdered() const override { return false; }
  std::uint8_t readU8(Field) override { return read<std::uint8_t>("u8"); }
  std::uint16_t readU16(Field) override { return read<std::uint16_t>("u16"); }
  std::int16_t readI16(Field) override { return read<std::int16_t>("i16"); }
  std::uint32_t readU32(Field) override { return read<std::uint32_t>("u32"); }
  bool finish() override { return true; }

  std::vector<std::string> types;

 private:
  template <class Number>
  Number read(const char* type) {
    types.emplace_back(type);
    return 0;
  }
};

/// @brief A writer that records the type of each field.
class TypesWriter final : public Writer {
 public:
  void writeU8(Field, std::uint8_t) override { types.emplace_back("u8"); }
  void writeU16(Field, std::uint16_t) override { types.emplace_back("u16"); }
  void writeI16(Field, std::int16_t) override { types.emplace_back("i16"); }
  void writeU32(Field, std::uint32_t) override { types.emplace_back("u32"); }
  void writeI32(Field, std::int32_t) override { types.emplace_back("i32"); }
  bool finish() override { return true; }

  std::vector<std::string> types;
};

/// @brief Returns the types of the fields of a frame, from the frame table. The type i8 of a turn
/// direction counts as u8, because a writer writes a turn direction as an unsigned byte.
std::vector<std::string> typesOf(std::string_view frame) {
  std::vector<std::string> types;
  for (const scenario::FrameRow& row : scenario::kFrameRows) {
    if (row.frame == frame) {
      types.emplace_back(row.type == "i8" ? "u8" : row.type);
    }
  }
  return types;
}

/// @brief The two values of a constant: the firmware has one value, and the frame table has the
/// other value.
struct Number {
  const char* name;
  unsigned firmware;
  unsigned table;
};

constexpr auto kNumbers = std::to_array<Number>({
#include "sim/scenario/FirmwareNumbers.inc"
});

/// @brief The CRC-32 of the digits 1 to 9 is the known check value.
/// @verifies FR-246
TEST(Layout, CheckValueOfTheHash) {
  EXPECT_EQ(crc32("123456789"), 0xCBF43926U);
}

/// @brief The hash in the Welcome is the CRC-32 of the names, types and offsets of all fields.
/// @verifies FR-246
TEST(Layout, FR246_TheHashIsThatOfTheTable) {
  EXPECT_EQ(firmwareIdentity.schemaHash, crc32(schema()));
  EXPECT_EQ(scenario::kTableHash, crc32(schema()));
}

/// @brief In the frame table, the fields of each frame follow each other without a gap.
/// @verifies FR-170
TEST(Layout, FR170_FieldsFollowEachOther) {
  std::map<std::string_view, std::size_t> lengths;
  for (const scenario::FrameRow& row : scenario::kFrameRows) {
    EXPECT_EQ(row.offset, lengths[row.frame]) << row.frame << ' ' << row.field;
    lengths[row.frame] += row.size;
  }
  EXPECT_EQ(lengths["Order"], SerialReader::kOrderLength);
}

/// @brief Each frame type, state, mode, cause and fault has the same number in the firmware and in
/// the frame table.
/// @verifies FR-170
TEST(Layout, FR170_EachNameHasTheNumberOfTheTable) {
  EXPECT_GE(kNumbers.size(), 50U);
  for (const Number& number : kNumbers) {
    EXPECT_EQ(number.firmware, number.table) << number.name;
  }
}

/// @brief The limits of orders in the firmware are equal to the limits in the frame table.
/// @verifies FR-170
TEST(Layout, FR170_LimitsOfOrdersAreThoseOfTheTable) {
  using scenario::limitOf;
  EXPECT_EQ(SystemConstants::instance().steeringLimit().count(), limitOf("steering_set_point"));
  EXPECT_EQ(SystemConstants::instance().velocityLimit().count(), limitOf("Velocity"));
  EXPECT_EQ(SystemConstants::instance().tensionLimit().count(), limitOf("Tension"));
  EXPECT_EQ(SystemConstants::instance().currentLimit().count(), limitOf("Current"));
}

/// @brief The fields of an order are read with the types and in the sequence of the frame table.
/// The fields of a report are written with the types and in the sequence of this table.
/// @verifies FR-170
TEST(Layout, FR170_OrderAndReportHaveTheFieldsOfTheTable) {
  TypesReader order;
  ASSERT_TRUE(OrderMessage().readFrom(order));
  EXPECT_EQ(order.types, typesOf("Order"));
  TypesWriter report;
  ASSERT_TRUE(ReportMessage({}).writeTo(report));
  EXPECT_EQ(report.types, typesOf("Report"));
}

}  // namespace
}  // namespace wr
