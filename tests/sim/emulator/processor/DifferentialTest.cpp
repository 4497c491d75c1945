#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <iomanip>
#include <map>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "sim/emulator/processor/Core.hpp"
#include "sim/emulator/processor/Encodings.hpp"
#include "sim/emulator/processor/Reference.hpp"
#include "support/seed.hpp"

namespace wr::emulator::reference {
namespace {

constexpr int kTimes = 1000;  // instructions for each encoding
constexpr std::uint32_t kMiddle = kRam + kRamSize / 2;
constexpr std::array<unsigned, 5> kPointers{0, 1, 2, 3, 13};
constexpr std::array<unsigned, 4> kIndices{4, 5, 6, 7};
constexpr std::uint32_t kFpModes = 0x07C00000;
constexpr std::uint32_t kQ = 0x08000000;
constexpr std::uint32_t kRounding = 0x00C00000;

/// @brief A source of random instructions with random operands.
class Source {
 public:
  explicit Source(std::uint32_t seed) : engine_(seed) {}

  [[nodiscard]] std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>(engine_() % count);
  }

  /// Returns a random number. The number is often a limit of its range.
  [[nodiscard]] std::uint32_t word() {
    constexpr std::array<std::uint32_t, 10> kLimits{
        0, 1, 0xFFFFFFFF, 0x7FFFFFFF, 0x80000000, 0x8000, 0x7FFF, 0x80008000, 0x7FFF7FFF, 0x80};
    const std::uint32_t any = static_cast<std::uint32_t>(engine_());
    switch (below(4)) {
      case 0:
        return kLimits.at(below(kLimits.size()));
      case 1:
        return any & 0x3FU;
      default:
        return any;
    }
  }

  /// Returns the bits of a floating-point number of any kind, often near a limit.
  [[nodiscard]] std::uint32_t single() {
    constexpr std::array<std::uint32_t, 14> kLimits{
        0,          0x3F800000, 0x00800000, 0x007FFFFF, 1,          0x7F7FFFFF, 0x7F800000,
        0x7FC00000, 0x7FA00001, 0x33000000, 0x4F000000, 0x3F000000, 0x47000000, 0x38800000};
    const std::uint32_t any = static_cast<std::uint32_t>(engine_());
    switch (below(4)) {
      case 0:
        return kLimits.at(below(kLimits.size())) ^ (any & 0x80000000U);
      case 1:  // near 1 in magnitude; the sum of two such numbers can be small
        return (any & 0x83FFFFFFU) + 0x3E000000U;
      case 2:
        return (any & 0x807FFFFFU) | (0x60U + below(0x40)) << 23;
      default:
        return any;
    }
  }

  [[nodiscard]] State state() {
    State state;
    std::ranges::generate(state.core, [this] { return word(); });
    std::ranges::generate(state.single, [this] { return single(); });
    for (const unsigned pointer : kPointers) {
      state.core.at(pointer) = kMiddle + 4 * below(64);
    }
    for (const unsigned index : kIndices) {
      state.core.at(index) = 4 * below(32);
    }
    state.pc = kCode + 4 * below(64);
    state.flags = word() & 0xF80F0000U;
    state.fpscr = static_cast<std::uint32_t>(engine_()) & kFpModes;
    return state;
  }

  /// Fills the registers with random numbers. This is possible only for instructions that do not
  /// access memory.
  void scatter(State& state) {
    for (std::size_t i = 0; i < 13; ++i) {
      state.core.at(i) = word();
    }
    state.core[14] = word();
  }

  [[nodiscard]] std::uint32_t instruction(const Encoding& encoding) {
    while (true) {
      std::map<char, std::uint32_t> fields;
      const std::uint32_t bits = filled(encoding, fields);
      bool good = !fields.contains('v') || std::popcount(fields['v']) > 1;
      for (std::size_t i = 0; i + 1 < encoding.differ.size(); i += 2) {
        good = good && fields[encoding.differ[i]] != fields[encoding.differ[i + 1]];
      }
      if (good) {
        return bits;
      }
    }
  }

 private:
  std::uint32_t filled(const Encoding& encoding, std::map<char, std::uint32_t>& fields) {
    std::map<char, unsigned> widths;
    for (const char each : encoding.bits) {
      ++widths[each];
    }
    std::map<char, std::uint32_t> left;
    for (const auto& [letter, width] : widths) {
      fields[letter] = left[letter] = valueOf(letter, width);
    }
    std::uint32_t bits = 0;
    for (const char each : encoding.bits) {
      if (each == ' ') {
        continue;
      }
      std::uint32_t bit = each == '1' ? 1 : 0;
      if (each != '0' && each != '1') {
        bit = left[each] >> --widths[each] & 1U;
      }
      bits = bits << 1 | bit;
    }
    return bits;
  }

  std::uint32_t valueOf(char letter, unsigned width) {
    switch (letter) {
      case 'd':
      case 'e':
      case 'n':
      case 'm':
      case 'a': {
        if (width == 3) {
          return below(8);
        }
        const std::uint32_t number = below(14);
        return number == 13 ? 14 : number;
      }
      case 'b':
        return kPointers.at(below(width == 3 ? 4 : 5));
      case 'i':
        return kIndices.at(below(4));
      default:
        return static_cast<std::uint32_t>(engine_()) & ((width < 32 ? 1U << width : 0U) - 1U);
    }
  }

  std::mt19937 engine_;
};

/// @brief The interpreter of the virtual K64, with the same memory as the Cortex-M4 of Unicorn.
class OurCore {
 public:
  OurCore() {
    core_.memory.map(kCode, kCodeSize, Memory::Access::ReadWriteExecute);
    core_.memory.map(kRam, kRamSize, Memory::Access::ReadWrite);
    core_.fpu = {.on = true, .activates = true, .defaults = 0};
  }

  bool execute(std::span<const std::uint8_t> code, int instructions, State& state) {
    core_.memory.load(state.pc, code);
    Registers& x = core_.registers;
    x = Registers{};
    std::ranges::copy(state.core, x.r.begin());
    x.setFlags(state.flags);
    x.setGe(state.flags);
    x.s = state.single;
    x.control = Registers::kFpActive;
    x.fpscr = state.fpscr;
    core_.next = state.pc;
    Trap trap = Trap::None;
    for (int i = 0; i < instructions && trap == Trap::None; ++i) {
      core_.setStop(core_.cycles() + 1);
      trap = core_.run();
    }
    std::copy_n(x.r.begin(), state.core.size(), state.core.begin());
    state.flags = x.flags();
    state.single = x.s;
    state.fpscr = x.fpscr;
    state.pc = core_.next;
    return trap == Trap::None;
  }

  [[nodiscard]] std::span<std::uint8_t> ram() {
    return {core_.memory.stack(kRam, kRamSize), kRamSize};
  }

 private:
  Core core_{Timing::NoWaitStates};
};

std::string text(const State& state) {
  std::ostringstream stream;
  stream << std::hex << "pc " << state.pc << " flags " << state.flags << " fpscr " << state.fpscr
         << "\n core";
  for (const std::uint32_t each : state.core) {
    stream << " " << each;
  }
  stream << "\n single";
  for (const std::uint32_t each : state.single) {
    stream << " " << each;
  }
  return stream.str();
}

class DifferentialTest : public testing::TestWithParam<Encoding> {};

/// @brief Each instruction of encodings() has the same effect on registers, flags and memory in
/// both emulators: in the interpreter of the virtual K64, and in Unicorn.
TEST_P(DifferentialTest, InstructionDoesTheSameAsInUnicorn) {
  const Encoding& encoding = GetParam();
  const bool wide =
      std::ranges::count_if(encoding.bits, [](char each) { return each != ' '; }) > 16;
  const bool usesMemory = encoding.bits.find('b') != std::string_view::npos ||
                          encoding.bits.find('v') != std::string_view::npos;
  Source source(test::seed());
  static UnicornCore theirs;
  static OurCore ours;
  std::ranges::generate(theirs.ram(),
                        [&source] { return static_cast<std::uint8_t>(source.below(256)); });
  std::ranges::copy(theirs.ram(), ours.ram().begin());
  for (int i = 0; i < kTimes; ++i) {
    const State before = [&] {
      State state = source.state();
      if (encoding.toNearest) {
        state.fpscr &= ~kRounding;
      }
      if (!usesMemory) {
        source.scatter(state);
      }
      return state;
    }();
    const std::uint32_t bits = source.instruction(encoding);
    std::vector<std::uint8_t> code;
    const auto add = [&code](std::uint32_t half) {
      code.push_back(static_cast<std::uint8_t>(half));
      code.push_back(static_cast<std::uint8_t>(half >> 8));
    };
    const bool inBlock = i % 3 == 0;
    if (inBlock) {
      add(0xBF08U | source.below(14) << 4);
    }
    if (wide) {
      add(bits >> 16);
    }
    add(bits & 0xFFFFU);
    State ourState = before;
    State theirState = before;
    const bool ourEnd = ours.execute(code, inBlock ? 2 : 1, ourState);
    const bool theirEnd = theirs.execute(code, theirState);
    if (encoding.qTooOften) {
      theirState.flags = (theirState.flags & ~kQ) | (ourState.flags & kQ);
    }
    ASSERT_EQ(ourEnd, theirEnd) << encoding.name << std::hex << " " << bits;
    ASSERT_TRUE(ourEnd) << encoding.name << " must be executable: " << std::hex << bits;
    ASSERT_TRUE(ourState == theirState)
        << encoding.name << std::hex << " " << bits << (inBlock ? " in a block" : "")
        << "\nbefore: " << text(before) << "\nours: " << text(ourState)
        << "\ntheirs: " << text(theirState);
    ASSERT_TRUE(std::ranges::equal(ours.ram(), theirs.ram()))
        << encoding.name << std::hex << " " << bits;
  }
}

std::string nameOf(const testing::TestParamInfo<Encoding>& info) {
  std::string name = std::to_string(info.index) + "_";
  for (const char each : info.param.name) {
    if (std::isalnum(static_cast<unsigned char>(each)) != 0) {
      name.push_back(each);
    }
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Encodings, DifferentialTest, testing::ValuesIn(encodings()), nameOf);

}  // namespace
}  // namespace wr::emulator::reference
