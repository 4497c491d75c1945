#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "sim/emulator/processor/Core.hpp"

namespace wr::emulator {
namespace {

constexpr std::uint32_t kCode = 0x100;
constexpr std::uint32_t kLower = 0x1FFFF000;
constexpr std::uint32_t kUpper = 0x20000000;

/// @brief An instruction with a forbidden action, and the expected trap. The cases were written by
/// hand from the ARMv7-M ARM, because Unicorn does not detect most of these faults.
struct Case {
  std::string name;
  std::vector<std::uint16_t> halves;
  std::uint32_t base;  ///< register 1
  Trap trap;

  friend std::ostream& operator<<(std::ostream& stream, const Case& each) {
    return stream << each.name;
  }
};

class FaultTest : public testing::TestWithParam<Case> {
 protected:
  FaultTest() {
    core_.memory.map(0, 0x1000, Memory::Access::ReadExecute);
    core_.memory.map(kLower, 0x1000, Memory::Access::ReadWrite);
    core_.memory.map(kUpper, 0x1000, Memory::Access::ReadWrite);
    core_.memory.map(
        0x40000000, 0x1000, [](std::uint32_t, unsigned) { return 0U; },
        [](std::uint32_t, unsigned, std::uint32_t) {});
    core_.fpu.on = true;
    core_.trapsDivideByZero = true;
  }

  Trap execute(const std::vector<std::uint16_t>& halves) {
    std::vector<std::uint8_t> bytes;
    for (const std::uint16_t half : halves) {
      bytes.push_back(static_cast<std::uint8_t>(half));
      bytes.push_back(static_cast<std::uint8_t>(half >> 8));
    }
    core_.memory.load(kCode, bytes);
    core_.next = kCode;
    core_.setStop(core_.cycles() + 1);
    return core_.run();
  }

  Core core_{Timing::NoWaitStates};
};

/// @brief If an instruction causes a fault, the instruction changes no register. The core returns
/// the reason of the fault.
TEST_P(FaultTest, InstructionFaultsAndDoesNothing) {
  for (std::uint32_t i = 0; i < 13; ++i) {
    core_.registers.r.at(i) = i == 1 ? GetParam().base : 0;
  }
  const auto before = core_.registers.r;
  EXPECT_EQ(execute(GetParam().halves), GetParam().trap);
  EXPECT_TRUE(std::equal(before.begin(), before.end() - 1, core_.registers.r.begin()));
  EXPECT_EQ(core_.at(), kCode);
}

// See A3.2.1 for alignment, A5.1 for undefined instructions, A7.7.127 for division, and B3.1 for
// the memory map.
const std::vector<Case> kCases{
    {"LDM_unaligned", {0xE8B1, 0x000C}, kUpper + 2, Trap::Unaligned},
    {"STM_unaligned", {0xC10C}, kUpper + 1, Trap::Unaligned},
    {"LDRD_unaligned", {0xE9D1, 0x2300}, kUpper + 2, Trap::Unaligned},
    {"STRD_unaligned", {0xE9C1, 0x2300}, kUpper + 2, Trap::Unaligned},
    {"VLDR_unaligned", {0xED91, 0x0A00}, kUpper + 2, Trap::Unaligned},
    {"LDREX_unaligned", {0xE851, 0x0F00}, kUpper + 2, Trap::Unaligned},
    {"LDR_unaligned_of_device", {0x6808}, 0x40000002, Trap::Unaligned},
    {"STRH_unaligned_of_device", {0x8008}, 0x40000001, Trap::Unaligned},
    {"UDIV_by_zero", {0xFBB1, 0xF0F2}, 1, Trap::DivideByZero},
    {"UDF", {0xDE00}, 0, Trap::Undefined},
    {"UDF_long", {0xF7F0, 0xA000}, 0, Trap::Undefined},
    {"BLX_to_ARM_code", {0xF000, 0xE800}, 0, Trap::Undefined},
    {"SMC", {0xF7F0, 0x8000}, 0, Trap::Undefined},
    {"VADD_of_doubles", {0xEE30, 0x0B00}, 0, Trap::Undefined},
    {"vector_addition", {0xEF20, 0x0800}, 0, Trap::Undefined},
    {"MCR_of_coprocessor_15", {0xEE00, 0x0F10}, 0, Trap::NoCoprocessor},
    {"LDR_of_nothing", {0x6808}, 0x30000000, Trap::LoadBus},
    {"STR_to_nothing", {0x6008}, 0x30000000, Trap::StoreBus},
    {"STR_to_flash", {0x6008}, 0x200, Trap::FlashStore},
    {"LDR_across_the_border", {0x6808}, kUpper - 2, Trap::LoadAcross},
    {"STRH_across_the_border", {0x8008}, kUpper - 1, Trap::StoreAcross},
    {"LDR_kept_address_of_nothing", {0xF851, 0x0F04}, 0x30000000, Trap::LoadBus},
};

INSTANTIATE_TEST_SUITE_P(Cases, FaultTest, testing::ValuesIn(kCases),
                         [](const auto& each) { return each.param.name; });

/// @brief The processor must not execute code at some addresses. A branch to such an address causes
/// a fault at the target.
TEST_F(FaultTest, CodeIsExecutedWhereItIsAllowedOnly) {
  core_.registers.r[1] = kUpper + 1;
  EXPECT_EQ(execute({0x4708}), Trap::None);  // bx r1
  core_.setStop(core_.cycles() + 1);
  EXPECT_EQ(core_.run(), Trap::InstructionViolation);
  EXPECT_EQ(core_.at(), kUpper);
  core_.next = 0x00002000;
  core_.setStop(core_.cycles() + 1);
  EXPECT_EQ(core_.run(), Trap::InstructionBus);
}

/// @brief A branch to an even address leaves the Thumb state, which is the only state of this
/// processor.
TEST_F(FaultTest, BranchToEvenAddressIsAnInvalidState) {
  core_.registers.r[1] = 0x200;
  EXPECT_EQ(execute({0x4708}), Trap::InvalidState);
  EXPECT_FALSE(core_.registers.thumb);
  EXPECT_EQ(core_.next, 0x200U);
}

/// @brief A floating-point instruction causes a fault while the floating-point unit is off.
TEST_F(FaultTest, FloatingPointUnitMustBeOn) {
  core_.fpu.on = false;
  EXPECT_EQ(execute({0xEE30, 0x0A00}), Trap::FpuOff);
}

/// @brief The first use of the floating-point unit copies the modes of FPDSCR to FPSCR. The use is
/// recorded in CONTROL.
TEST_F(FaultTest, FirstUseOfTheFloatingPointUnitTakesItsDefaults) {
  core_.fpu = {.on = true, .activates = true, .defaults = 0x01000000};
  EXPECT_EQ(execute({0xEE30, 0x0A00}), Trap::None);
  EXPECT_EQ(core_.registers.fpscr, 0x01000000U);
  EXPECT_EQ(core_.registers.control, Registers::kFpActive);
}

/// @brief A conversion from a fixed-point number rounds to the nearest number, independent of FPSCR
/// (A7.7.230). Unicorn wrongly rounds by FPSCR.
TEST_F(FaultTest, ConversionFromFixedPointRoundsToNearest) {
  constexpr std::uint32_t kUp = 1U << 22;
  core_.registers.fpscr = kUp;
  core_.registers.s[0] = 0x01000001;  // this number needs one bit more than a float has
  EXPECT_EQ(execute({0xEEBB, 0x0AC8}), Trap::None);  // vcvt.f32.u32 s0, s0, #16
  EXPECT_EQ(core_.registers.s[0], 0x43800000U);      // the nearest number is 256
}

/// @brief SMLAD sets Q when the whole sum is too large. SMLAD does not set Q when only the sum of
/// the products is too large (A7.7.144). Unicorn sets Q in both cases.
TEST_F(FaultTest, DualProductSetsQForTheWholeSum) {
  core_.registers.r[1] = 0x80008000;  // the sum of the products is 2^31
  core_.registers.r[2] = 0xFFFFFFFF;
  EXPECT_EQ(execute({0xFB21, 0x2001}), Trap::None);  // smlad r0, r1, r1, r2
  EXPECT_EQ(core_.registers.r[0], 0x7FFFFFFFU);
  EXPECT_FALSE(core_.registers.q);
  core_.registers.r[2] = 0;
  EXPECT_EQ(execute({0xFB21, 0x2001}), Trap::None);
  EXPECT_TRUE(core_.registers.q);
}

/// @brief If the condition of an IT block is false, the instructions of the block have no effect. A
/// fault does not change the state of the block. The block can therefore continue after the
/// handler.
TEST_F(FaultTest, FaultInBlockKeepsTheBlock) {
  core_.registers.r[1] = 0x30000000;
  core_.registers.it = 0x08;  // condition EQ, last instruction of the block
  core_.registers.z = 1;
  EXPECT_EQ(execute({0x6808}), Trap::None);
  EXPECT_EQ(core_.registers.it, 0);
  core_.registers.it = 0x08;
  core_.registers.z = 0;
  EXPECT_EQ(execute({0x6808}), Trap::LoadBus);
  EXPECT_EQ(core_.registers.it, 0x08);
}

/// @brief BKPT is unconditional: in an IT block, it also stops the program if the condition of the
/// block is false (A7.7.17).
TEST_F(FaultTest, BreakpointInBlockIsUnconditional) {
  core_.registers.it = 0x08;  // condition EQ, last instruction of the block
  core_.registers.z = 1;      // the condition is false
  EXPECT_EQ(execute({0xBE00}), Trap::Breakpoint);
}

/// @brief A store-exclusive instruction stores only after a load-exclusive instruction. The result
/// of the store-exclusive instruction shows whether it has stored a value.
TEST_F(FaultTest, StoreExclusiveNeedsLoadExclusive) {
  core_.registers.r[1] = kUpper;
  core_.registers.r[2] = 7;
  EXPECT_EQ(execute({0xE841, 0x2000}), Trap::None);  // strex r0, r2, [r1]
  EXPECT_EQ(core_.registers.r[0], 1U);
  EXPECT_EQ(execute({0xE851, 0x3F00}), Trap::None);  // ldrex r3, [r1]
  EXPECT_EQ(execute({0xE841, 0x2000}), Trap::None);
  EXPECT_EQ(core_.registers.r[0], 0U);
  EXPECT_EQ(core_.memory.read<std::uint32_t>(kUpper), 7U);
}

}  // namespace
}  // namespace wr::emulator
