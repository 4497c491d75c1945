#include "sim/emulator/ExecutedCode.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "sim/emulator/CortexM4.hpp"

namespace wr::emulator {
namespace {

/// @brief In the record of the executed code, each half-word of the lower RAM and of the flash has
/// a bit. Other addresses have no bit.
TEST(ExecutedCodeTest, EachHalfWordHasItsBit) {
  constexpr std::size_t kRamBytes = 0x10000 / 16;
  ExecutedCode code;
  for (const std::uint32_t address :
       {0x1FFF0000U, 0x1FFFFFFEU, 0U, 0x12U, 0xFFFFEU, 0x100000U, 0x20000000U, 0x1FFEFFFEU}) {
    code.note(address);
  }
  const auto bits = code.bits();
  EXPECT_EQ(bits.size(), kRamBytes + 0x10000);
  EXPECT_EQ(bits[0], 0b1);
  EXPECT_EQ(bits[kRamBytes - 1], 0b1000'0000);
  EXPECT_EQ(bits[kRamBytes], 0b1);
  EXPECT_EQ(bits[kRamBytes + 1], 0b10);
  EXPECT_EQ(bits.back(), 0b1000'0000);
  EXPECT_EQ(std::ranges::count(bits, 0), static_cast<std::ptrdiff_t>(bits.size()) - 5);
  EXPECT_TRUE(code.noted(0x12));
  EXPECT_TRUE(code.noted(0x1FFF0000));
  EXPECT_FALSE(code.noted(0x10));
  EXPECT_FALSE(code.noted(0x100000));
  EXPECT_FALSE(code.noted(0x20000000));
}

/// @brief Each half-word number belongs to one address.
TEST(ExecutedCodeTest, EachHalfWordHasItsAddress) {
  EXPECT_EQ(ExecutedCode::addressOf(0), 0x1FFF0000U);
  EXPECT_EQ(ExecutedCode::addressOf(0x8000), 0U);
  EXPECT_EQ(ExecutedCode::addressOf(ExecutedCode::kHalves - 1), 0xFFFFEU);
}

/// @brief The processor records the instructions that it executes, but not the instructions that a
/// branch skips.
TEST(ExecutedCodeTest, WhatIsJumpedOverIsNotExecuted) {
  constexpr std::uint32_t kCode = 0x100;
  const std::array<std::uint8_t, 8> vectors{0, 8, 0, 0, 0x01, 0x01, 0, 0};  // start at kCode
  const std::array<std::uint8_t, 8> program{0x01, 0x20,                     // movs r0, #1
                                            0x00, 0xE0,   // branch (b) to the last instruction
                                            0x01, 0x21,   // movs r1, #1
                                            0xFE, 0xE7};  // branch (b) to itself
  CortexM4 cpu;
  cpu.mapMemory(0, 0x1000, CortexM4::Access::ReadWriteExecute);
  cpu.load(0, vectors);
  cpu.load(kCode, program);
  ExecutedCode code;
  cpu.noteExecuted(code);
  cpu.reset();
  ASSERT_EQ(cpu.run(10), CortexM4::Stop::Limit);
  EXPECT_TRUE(code.noted(kCode));
  EXPECT_TRUE(code.noted(kCode + 2));
  EXPECT_FALSE(code.noted(kCode + 4));
  EXPECT_TRUE(code.noted(kCode + 6));
}

}  // namespace
}  // namespace wr::emulator
