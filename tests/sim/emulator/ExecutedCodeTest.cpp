#include "sim/emulator/ExecutedCode.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "sim/emulator/CortexM4.hpp"

namespace wr::emulator {
namespace {

/// @brief Each half-word of the flash has its bit; other addresses have none.
TEST(ExecutedCodeTest, EachHalfWordHasItsBit) {
  ExecutedCode code;
  code.note(0);
  code.note(0x12);
  code.note(0xFFFFE);
  code.note(0x100000);
  code.note(0x1FFF0000);
  EXPECT_EQ(code.bits().size(), 0x10000U);
  EXPECT_EQ(code.bits()[0], 0b1);
  EXPECT_EQ(code.bits()[1], 0b10);
  EXPECT_EQ(code.bits()[0xFFFF], 0b1000'0000);
  EXPECT_EQ(std::ranges::count(code.bits(), 0), 0x10000 - 3);
  EXPECT_TRUE(code.noted(0x12));
  EXPECT_FALSE(code.noted(0x10));
  EXPECT_FALSE(code.noted(0x100000));
}

/// @brief The processor records executed instructions, and none that it jumps over.
TEST(ExecutedCodeTest, WhatIsJumpedOverIsNotExecuted) {
  constexpr std::uint32_t kCode = 0x100;
  const std::array<std::uint8_t, 8> vectors{0, 8, 0, 0, 0x01, 0x01, 0, 0};  // start at kCode
  const std::array<std::uint8_t, 8> program{0x01, 0x20,                     // movs r0, #1
                                            0x00, 0xE0,                     // b to the last one
                                            0x01, 0x21,                     // movs r1, #1
                                            0xFE, 0xE7};                    // b to itself
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
