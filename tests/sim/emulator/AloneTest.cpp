// A raw program file that is not part of the firmware. The program runs on the virtual board
// without a robot and without symbols.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "sim/emulator/Image.hpp"
#include "sim/emulator/RegisterNames.hpp"
#include "sim/emulator/VirtualBoard.hpp"

namespace wr::test {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

emulator::VirtualBoard switchedOn(emulator::Options options = {}) {
  return emulator::VirtualBoard(emulator::readImage(WR_ALONE_PROGRAM), std::move(options));
}

std::string sentBy(emulator::VirtualBoard& board) {
  const std::vector<std::uint8_t> sent = board.takeSent();
  return {sent.begin(), sent.end()};
}

/// @brief The program prints its banner and the voltages at the input of the converter.
TEST(AloneTest, PrintsBannerAndVoltages) {
  emulator::VirtualBoard board = switchedOn();
  board.setAnalog(0, 8, 1.65);
  ASSERT_TRUE(board.runUntil(150ms));
  board.setAnalog(0, 8, 3.3);
  ASSERT_TRUE(board.runUntil(250ms));
  EXPECT_EQ(sentBy(board), "alone on a K64\r\n1650 mV\r\n3300 mV\r\n");
}

/// @brief The level of the LED pin changes every 50 ms.
TEST(AloneTest, BlinksWithItsTimer) {
  emulator::VirtualBoard board = switchedOn();
  std::vector<std::chrono::milliseconds> changes;
  board.onEvent([&](const emulator::Event& event) {
    if (event.kind == emulator::Event::Kind::PinChanged && event.number == 4 * 32 + 6) {
      changes.push_back(std::chrono::duration_cast<std::chrono::milliseconds>(event.at));
    }
  });
  ASSERT_TRUE(board.runUntil(225ms));
  EXPECT_THAT(changes, testing::ElementsAre(0ms, 50ms, 100ms, 150ms, 200ms));
  EXPECT_TRUE(board.isOutput('E', 6));
}

/// @brief An access to a register without a model stops the run. The finding contains the register,
/// the address and the instruction.
TEST(AloneTest, UnmodelledRegisterIsNamed) {
  emulator::VirtualBoard board = switchedOn();
  ASSERT_TRUE(board.runUntil(10ms));
  const std::vector<std::uint8_t> command{'d'};
  board.receive(command);
  EXPECT_FALSE(board.runUntil(20ms));
  ASSERT_TRUE(board.finding().has_value());
  EXPECT_EQ(board.finding()->id, "unmodelled-register");
  const std::string text = emulator::textOf(*board.finding());
  EXPECT_THAT(text, HasSubstr("store to DAC0_C0 at 0x400CC021"));
  EXPECT_THAT(text, testing::ContainsRegex("at pc 0x[0-9A-F]+, 1[0-9][.][0-9]{3} ms"));
}

/// @brief If the option unmodelledIsFinding is false, an access to a register without a model is
/// only a warning. The access has no effect, and is reported once.
TEST(AloneTest, UnmodelledRegisterCanBeAWarning) {
  emulator::VirtualBoard board = switchedOn({.unmodelledIsFinding = false});
  ASSERT_TRUE(board.runUntil(10ms));
  const std::vector<std::uint8_t> command{'d', 'd'};
  board.receive(command);
  ASSERT_TRUE(board.runUntil(20ms));
  const std::vector<emulator::Finding> warnings = board.takeWarnings();
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0].what, HasSubstr("DAC0_C0"));
  EXPECT_EQ(sentBy(board), "alone on a K64\r\nDAC\r\nDAC\r\n");
  EXPECT_TRUE(board.takeWarnings().empty());
}

struct Named {
  std::uint32_t address;
  std::string name;
};

class RegisterNamesTest : public testing::TestWithParam<Named> {};

/// @brief Findings contain the register names of the manual's memory maps.
TEST_P(RegisterNamesTest, IsThatOfTheManual) {
  EXPECT_EQ(emulator::registerName(GetParam().address), GetParam().name);
}

INSTANTIATE_TEST_SUITE_P(
    Manual, RegisterNamesTest,
    testing::Values(Named{0x40008000, "DMA_CR"}, Named{0x4000901C, "TCD0_CSR"},
                    Named{0x400091FE, "TCD15_BITER"}, Named{0x40021003, "DMAMUX_CHCFG3"},
                    Named{0x4002C034, "SPI0_PUSHR"}, Named{0x40037104, "PIT_CVAL0"},
                    Named{0x4003808C, "FTM0_SYNCONF"}, Named{0x40048038, "SIM_SCGC5"},
                    Named{0x4004B018, "PORTC_PCR6"}, Named{0x4006600A, "I2C0 + 0xA"},
                    Named{0x40067003, "I2C1_S"}, Named{0x4006B004, "UART1_S1"},
                    Named{0x40073009, "CMP1_CR1"}, Named{0x400CC021, "DAC0_C0"},
                    Named{0x400FF10C, "GPIOE_PTOR"}, Named{0x40001000, ""}, Named{0x400FF140, ""}));

class OtherFormatTest : public testing::TestWithParam<const char*> {};

/// @brief A file of another format is rejected. The error message contains the command that
/// converts the file.
TEST_P(OtherFormatTest, IsRefused) {
  const auto file = std::filesystem::temp_directory_path() / "other_format.bin";
  std::ofstream(file, std::ios::binary) << GetParam() << "more";
  try {
    static_cast<void>(emulator::readImage(file));
    ADD_FAILURE() << "the file was not rejected";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("objcopy -O binary"));
  }
  std::filesystem::remove(file);
}

INSTANTIATE_TEST_SUITE_P(Formats, OtherFormatTest, testing::Values("\x7f\x45LF", ":10", "S0"));

}  // namespace
}  // namespace wr::test
