#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "communication/framing/Frame.hpp"
#include "communication/serialization/OrderMessage.hpp"
#include "communication/serialization/ReportMessage.hpp"
#include "sim/scenario/FrameFields.hpp"

namespace wr {
namespace {

/// @brief A line of the table of fields.
struct Row {
  std::string frame;
  std::string field;
  std::string type;
  std::size_t offset = 0;
};

std::string table() {
  std::ifstream file(WR_SOURCE_DIR "/design/frames.txt");
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<Row> rowsOf(const std::string& frame) {
  std::vector<Row> rows;
  std::istringstream lines(table());
  for (Row row; lines >> row.frame >> row.field >> row.type >> row.offset;) {
    if (row.frame == frame) {
      rows.push_back(row);
    }
  }
  return rows;
}

std::size_t sizeOf(const std::string& type) {
  static const std::map<std::string, std::size_t> sizes{
      {"u8", 1}, {"i8", 1}, {"u16", 2}, {"i16", 2}, {"u32", 4}, {"i32", 4}, {"char8", 8}};
  return sizes.at(type);
}

/// @brief CRC-32 as in Ethernet and zlib: polynomial 0x04C11DB7, reflected, one bit at a time.
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

/// @brief Writer that records the type of each field.
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

/// @brief The types of a frame in the table. A turn direction is written as the byte that it is.
std::vector<std::string> typesOf(const std::string& frame) {
  std::vector<std::string> types;
  for (const Row& row : rowsOf(frame)) {
    types.push_back(row.type == "i8" ? "u8" : row.type);
  }
  return types;
}

/// @brief The check value of CRC-32, that of the nine digits.
/// @verifies FR-246
TEST(Layout, CheckValueOfTheHash) {
  EXPECT_EQ(crc32("123456789"), 0xCBF43926U);
}

/// @brief The hash of the Welcome is the CRC-32 of the table of fields.
/// @verifies FR-246
TEST(Layout, FR246_TheHashIsThatOfTheTable) {
  EXPECT_EQ(kSchemaHash, crc32(table()));
}

/// @brief In the table the fields of each frame follow each other without a gap.
/// @verifies FR-170
TEST(Layout, FR170_FieldsFollowEachOther) {
  const std::map<std::string, std::size_t> lengths{{"Hello", 6},   {"Welcome", 29},
                                                   {"Confirm", 1}, {"KeepAlive", 0},
                                                   {"Order", 21},  {"Report", 130}};
  for (const auto& [frame, length] : lengths) {
    SCOPED_TRACE(frame);
    std::size_t offset = 0;
    for (const Row& row : rowsOf(frame)) {
      EXPECT_EQ(row.offset, offset) << row.field;
      offset += sizeOf(row.type);
    }
    EXPECT_EQ(offset, length);
  }
}

/// @brief An order and a report are written with the types of the table, in its sequence.
/// @verifies FR-170
TEST(Layout, FR170_OrderAndReportAreWrittenAsInTheTable) {
  TypesWriter order;
  ASSERT_TRUE(OrderMessage().writeTo(order));
  EXPECT_EQ(order.types, typesOf("Order"));
  TypesWriter report;
  ASSERT_TRUE(ReportMessage().writeTo(report));
  EXPECT_EQ(report.types, typesOf("Report"));
}

/// @brief Scenarios read each field of Welcome and Report at its place of the table.
/// @verifies FR-170
TEST(Layout, FR170_ScenariosReadTheFieldsOfTheTable) {
  using Form = FrameField::Form;
  const std::map<Form, std::string> types{{Form::U8, "u8"},   {Form::I8, "i8"},
                                          {Form::U16, "u16"}, {Form::I16, "i16"},
                                          {Form::U32, "u32"}, {Form::I32, "i32"}};
  int compared = 0;
  for (const char* frame : {"Welcome", "Report"}) {
    for (const Row& row : rowsOf(frame)) {
      const auto type = row.frame == "Welcome" ? kWelcomeType : kReportType;
      for (const FrameField& field : frameFields()) {
        if (field.name == row.field && field.type == type && field.form != Form::Bit) {
          EXPECT_EQ(field.offset, row.offset) << row.field;
          EXPECT_EQ(types.at(field.form), row.type) << row.field;
          ++compared;
        }
      }
    }
  }
  EXPECT_GE(compared, 70);
}

}  // namespace
}  // namespace wr
