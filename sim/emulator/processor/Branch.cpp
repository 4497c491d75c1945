#include <array>
#include <cstddef>
#include <utility>

#include "sim/emulator/processor/Core.hpp"
#include "sim/emulator/processor/Encoding.hpp"

// Branches (ARMv7-M ARM, A5.2.6, A5.3.4, A7.7.12 to A7.7.21). The field `value` is the distance
// from the program counter.

namespace wr::emulator {

namespace {

void branchTo(Core& core, const Instruction& in) {
  core.branch(core.registers.r[Registers::kPc] + in.value);
}

template <unsigned kCondition>
void branchIf(Core& core, const Instruction& in) {
  if (core.registers.passes(kCondition)) {
    branchTo(core, in);
  }
}

template <std::size_t... kCondition>
constexpr auto conditional(std::index_sequence<kCondition...> /*conditions*/) {
  return std::array<Instruction::Operation, sizeof...(kCondition)>{branchIf<kCondition>...};
}

constexpr auto kConditional = conditional(std::make_index_sequence<14>());

void branchAndLink(Core& core, const Instruction& in) {
  core.registers.r[Registers::kLink] = core.next | 1U;
  branchTo(core, in);
}

void exchange(Core& core, const Instruction& in) {
  core.branchAndExchange(core.registers.r[in.m]);
}

void linkAndExchange(Core& core, const Instruction& in) {
  const std::uint32_t target = core.registers.r[in.m];
  core.registers.r[Registers::kLink] = core.next | 1U;
  core.branchOnly(target);
}

template <bool kNonZero>
void compare(Core& core, const Instruction& in) {
  if ((core.registers.r[in.n] != 0) == kNonZero) {
    branchTo(core, in);
  }
}

// Returns the value after sign extension from the given number of bits.
std::uint32_t withSign(std::uint32_t value, unsigned bits) {
  const std::uint32_t sign = 1U << (bits - 1);
  return (value ^ sign) - sign;
}

}  // namespace

Instruction shortBranch(Encoding code) {
  if (code.bit(13)) {
    return {.run = branchTo, .value = withSign(code.field(10, 0) << 1, 12)};
  }
  return {.run = kConditional[code.field(11, 8)], .value = withSign(code.field(7, 0) << 1, 9)};
}

Instruction branchAndExchange(Encoding code) {
  return {.run = code.bit(7) ? linkAndExchange : exchange, .m = code.reg(3)};
}

Instruction compareAndBranch(Encoding code) {
  return {.run = code.bit(11) ? compare<true> : compare<false>,
          .value = code.field(9, 9) << 6 | code.field(7, 3) << 1,
          .n = code.low(0)};
}

Instruction branch(Encoding code) {
  const std::uint32_t sign = code.field(26, 26);
  if (!code.bit(14) && !code.bit(12)) {
    const std::uint32_t distance = sign << 20 | code.field(11, 11) << 19 |
                                   code.field(13, 13) << 18 | code.field(21, 16) << 12 |
                                   code.field(10, 0) << 1;
    return {.run = kConditional[code.field(25, 22)], .value = withSign(distance, 21)};
  }
  if (!code.bit(12)) {
    return undefined();  // BLX to the other instruction set
  }
  const std::uint32_t first = ~(code.field(13, 13) ^ sign) & 1U;
  const std::uint32_t second = ~(code.field(11, 11) ^ sign) & 1U;
  const std::uint32_t distance =
      sign << 24 | first << 23 | second << 22 | code.field(25, 16) << 12 | code.field(10, 0) << 1;
  return {.run = code.bit(14) ? branchAndLink : branchTo, .value = withSign(distance, 25)};
}

}  // namespace wr::emulator
