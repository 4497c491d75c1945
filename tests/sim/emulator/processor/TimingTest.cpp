#include <gtest/gtest.h>

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "sim/emulator/Timing.hpp"
#include "sim/emulator/processor/Core.hpp"

namespace wr::emulator {
namespace {

constexpr std::uint32_t kRam = 0x20000000;
constexpr std::uint32_t kRamSize = 0x1000;
constexpr std::uint32_t kFlashSize = 0x1000;
constexpr std::uint32_t kOdd = 0x201;  // target of branches

/// @brief A core with flash at address 0 and with RAM. All registers point to the word in the
/// middle of the RAM. This word contains the address of an instruction.
class Program {
 public:
  Program(Timing timing, std::uint32_t at, std::vector<std::uint16_t> halves) : core_(timing) {
    core_.memory.map(0, kFlashSize, Memory::Access::ReadExecute);
    core_.memory.map(kRam, kRamSize, Memory::Access::ReadWrite);
    core_.fpu.on = true;
    std::vector<std::uint8_t> bytes;
    for (const std::uint16_t half : halves) {
      bytes.push_back(static_cast<std::uint8_t>(half));
      bytes.push_back(static_cast<std::uint8_t>(half >> 8));
    }
    core_.memory.load(at, bytes);
    core_.registers.r.fill(kRam + kRamSize / 2);
    core_.registers.r[Registers::kLink] = kOdd;
    static_cast<void>(core_.store<std::uint32_t>(core_.registers.r[1], kOdd));
    core_.next = at;
  }

  /// Executes the next instructions, and returns the number of their cycles.
  std::uint64_t cyclesOf(int instructions) {
    const std::uint64_t before = core_.cycles();
    for (int i = 0; i < instructions; ++i) {
      core_.setStop(core_.cycles() + 1);
      EXPECT_EQ(core_.run(), Trap::None);
    }
    return core_.cycles() - before;
  }

  Core& core() { return core_; }

 private:
  Core core_;
};

/// @brief A row of the manual's tables.
struct Row {
  std::string name;
  std::vector<std::uint16_t> halves;
  std::uint64_t cycles;

  friend std::ostream& operator<<(std::ostream& stream, const Row& row) {
    return stream << row.name;
  }
};

class TimingTest : public testing::TestWithParam<Row> {};

/// @brief An instruction takes the number of cycles that the manual of the processor states. If the
/// manual states a range, the instruction takes the greatest number of this range.
TEST_P(TimingTest, InstructionTakesTheCyclesOfTheManual) {
  Program program(Timing::NoWaitStates, 0x100, GetParam().halves);
  EXPECT_EQ(program.cyclesOf(1), GetParam().cycles);
  EXPECT_EQ(program.core().instructions(), 1U);
}

// From ARM DDI 0439, table 3-1, with P = 3. The row VABS and all later rows are from table 7-1.
const Row kRows[] = {{"MOV", {0x4608}, 1},
                     {"MOVW", {0xF240, 0x0000}, 1},
                     {"MOV_to_PC", {0x46F7}, 4},
                     {"ADD", {0x1840}, 1},
                     {"MUL", {0x4348}, 1},
                     {"MLA", {0xFB00, 0x2001}, 1},
                     {"SMLAL", {0xFBC2, 0x0103}, 1},
                     {"UDIV", {0xFBB0, 0xF0F1}, 12},
                     {"SSAT", {0xF300, 0x0000}, 1},
                     {"CMP", {0x4288}, 1},
                     {"LSL", {0x4088}, 1},
                     {"CLZ", {0xFAB0, 0xF080}, 1},
                     {"LDR", {0x6808}, 2},
                     {"LDR_to_PC", {0xF8D1, 0xF000}, 5},
                     {"LDR_unaligned_by_2", {0xF8D1, 0x0002}, 3},
                     {"LDR_unaligned_by_1", {0xF8D1, 0x0001}, 4},
                     {"LDRH_unaligned", {0xF8B1, 0x0001}, 3},
                     {"LDRD", {0xE9D1, 0x2300}, 3},
                     {"LDM_of_4", {0xC93C}, 5},
                     {"LDREX", {0xE851, 0x0F00}, 2},
                     {"STR", {0x6008}, 2},
                     {"STRD", {0xE9C1, 0x2300}, 3},
                     {"STM_of_3", {0xC11C}, 4},
                     {"PUSH_of_3", {0xB503}, 4},
                     {"POP_of_2", {0xBC03}, 3},
                     {"B", {0xE7FE}, 4},
                     {"BNE_not_taken", {0xD0FE}, 1},
                     {"BNE_taken", {0xD1FE}, 4},
                     {"BL", {0xF7FF, 0xFFFE}, 4},
                     {"BLX", {0x47F0}, 4},
                     {"CBZ_not_taken", {0xB100}, 1},
                     {"CBNZ_taken", {0xB900}, 4},
                     {"IT", {0xBF08}, 1},
                     {"CPSIE", {0xB662}, 2},
                     {"MRS", {0xF3EF, 0x8000}, 2},
                     {"UXTB", {0xB2C0}, 1},
                     {"UBFX", {0xF3C0, 0x0007}, 1},
                     {"REV", {0xBA00}, 1},
                     {"NOP", {0xBF00}, 1},
                     {"DMB", {0xF3BF, 0x8F5F}, 1},
                     {"ISB", {0xF3BF, 0x8F6F}, 4},
                     {"VABS", {0xEEB0, 0x0AC0}, 1},
                     {"VADD", {0xEE30, 0x0A00}, 1},
                     {"VCVT", {0xEEB8, 0x0AC0}, 1},
                     {"VDIV", {0xEE80, 0x0A00}, 14},
                     {"VFMA", {0xEEA0, 0x0A00}, 3},
                     {"VLDM_of_4", {0xEC91, 0x0A04}, 5},
                     {"VLDR", {0xED91, 0x0A00}, 2},
                     {"VLDR_double", {0xED91, 0x0B00}, 3},
                     {"VMLA", {0xEE00, 0x0A00}, 3},
                     {"VMOV_two", {0xEC51, 0x0A10}, 2},
                     {"VMRS", {0xEEF1, 0x0A10}, 1},
                     {"VMUL", {0xEE20, 0x0A00}, 1},
                     {"VPUSH_of_2", {0xED2D, 0x0A02}, 3},
                     {"VSQRT", {0xEEB1, 0x0AC0}, 14}};

std::vector<Row> rows() {
  std::vector<Row> all(std::begin(kRows), std::end(kRows));
  for (Row& row : all) {
    row.halves.resize(4, 0xBF00);
  }
  return all;
}

INSTANTIATE_TEST_SUITE_P(Rows, TimingTest, testing::ValuesIn(rows()),
                         [](const auto& each) { return each.param.name; });

constexpr std::uint16_t kNop = 0xBF00;

/// @brief The flash is read in phrases of 8 bytes. The first instruction in a phrase takes 5
/// additional cycles. The next instructions in the phrase take no additional cycles.
TEST(SlowFlashTest, EachPhraseCostsOnce) {
  Program program(Timing::SlowFlash, 0x100, std::vector<std::uint16_t>(8, kNop));
  EXPECT_EQ(program.cyclesOf(1), 6U);
  EXPECT_EQ(program.cyclesOf(3), 3U);
  EXPECT_EQ(program.cyclesOf(1), 6U);
  EXPECT_EQ(program.cyclesOf(3), 3U);
}

/// @brief If the halves of an instruction of 4 bytes are in two phrases, the instruction waits for
/// both phrases.
TEST(SlowFlashTest, InstructionAcrossTwoPhrasesWaitsForBoth) {
  Program program(Timing::SlowFlash, 0x106, {0xF240, 0x0000, kNop});
  EXPECT_EQ(program.cyclesOf(1), 1U + 5 + 5);
  EXPECT_EQ(program.cyclesOf(1), 1U);
}

/// @brief A branch back to the phrase of the last read needs no new read. A branch to another
/// phrase needs a new read, even when this phrase was read earlier.
TEST(SlowFlashTest, OnlyTheLastPhraseIsKept) {
  Program same(Timing::SlowFlash, 0x100, {0xE7FE});
  EXPECT_EQ(same.cyclesOf(1), 4U + 5);
  EXPECT_EQ(same.cyclesOf(1), 4U);
  // branch to 0x108; from there, branch back to 0x100
  Program other(Timing::SlowFlash, 0x100, {0xE002, kNop, kNop, kNop, 0xE7FA});
  EXPECT_EQ(other.cyclesOf(3), 3U * (4 + 5));
}

/// @brief Each read of a word of data in flash takes 5 additional cycles. A read of data in RAM
/// takes no additional cycles.
TEST(SlowFlashTest, DataOfFlashCostsEachTime) {
  const std::vector<std::uint16_t> loads{0x6808, 0x6808, 0x6810, 0x6811};  // r0 = [r1], r0 = [r2]
  Program program(Timing::SlowFlash, 0x100, loads);
  program.core().registers.r[1] = 0x200;
  EXPECT_EQ(program.cyclesOf(1), 2U + 5 + 5);
  EXPECT_EQ(program.cyclesOf(1), 2U + 5);
  EXPECT_EQ(program.cyclesOf(1), 2U);
}

/// @brief An instruction that loads several words needs one read for each word. An unaligned word
/// needs two reads.
TEST(SlowFlashTest, EachWordOfDataCosts) {
  Program program(Timing::SlowFlash, 0x100, {0xC93C, 0xF8D1, 0x0002, kNop});  // LDM of 4, LDR
  program.core().registers.r[1] = 0x200;
  EXPECT_EQ(program.cyclesOf(1), 5U + 5 + 4 * 5);
  EXPECT_EQ(program.cyclesOf(1), 3U + 2 * 5);
}

/// @brief Without wait states, an instruction takes the same number of cycles in each memory. The
/// memory that contains the data of the instruction has no effect either.
TEST(SlowFlashTest, NoWaitStatesCostNothing) {
  Program program(Timing::NoWaitStates, 0x106, {0xF240, 0x0000, 0x6808});
  program.core().registers.r[1] = 0x200;
  EXPECT_EQ(program.cyclesOf(2), 3U);
}

}  // namespace
}  // namespace wr::emulator
