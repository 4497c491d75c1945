#include <array>
#include <bit>
#include <cstddef>
#include <utility>

#include "sim/emulator/processor/Core.hpp"
#include "sim/emulator/processor/Encoding.hpp"

// Moves, logic, sums and comparisons (ARMv7-M ARM, A5.2.1 to A5.2.3, A5.3.1, A5.3.11).

namespace wr::emulator {

namespace {

enum class What : std::uint8_t {
  And,
  Bic,
  Orr,
  Orn,
  Eor,
  Mov,
  Mvn,
  Tst,
  Teq,
  Add,
  Adc,
  Sub,
  Sbc,
  Rsb,
  Cmp,
  Cmn
};
constexpr std::size_t kWhats = 16;

/// The form of the second operand.
enum class Second : std::uint8_t {
  Number,         ///< value; the carry does not change
  NumberAndFlag,  ///< value; the carry becomes the highest bit of value
  Register,       ///< register m; the carry does not change
  Lsl,            ///< register m, shifted by value
  Lsr,            ///< shift by value, 1 to 32
  Asr,            ///< shift by value, 1 to 32
  Ror,            ///< rotation by value, 1 to 31
  Rrx
};
constexpr std::size_t kSeconds = 8;

struct Shifted {
  std::uint32_t value;
  std::uint32_t carry;
};

// Shift_C of ARMv7-M ARM, A2.2.1, by 0 to 255 bits.
Shifted lsl(std::uint32_t value, std::uint32_t by, std::uint32_t carry) {
  return by == 0    ? Shifted{value, carry}
         : by < 32  ? Shifted{value << by, value >> (32 - by) & 1U}
         : by == 32 ? Shifted{0, value & 1U}
                    : Shifted{0, 0};
}

Shifted lsr(std::uint32_t value, std::uint32_t by, std::uint32_t carry) {
  return by == 0    ? Shifted{value, carry}
         : by < 32  ? Shifted{value >> by, value >> (by - 1) & 1U}
         : by == 32 ? Shifted{0, value >> 31}
                    : Shifted{0, 0};
}

Shifted asr(std::uint32_t value, std::uint32_t by, std::uint32_t carry) {
  const auto number = static_cast<std::int32_t>(value);
  return by == 0   ? Shifted{value, carry}
         : by < 32 ? Shifted{static_cast<std::uint32_t>(number >> by), value >> (by - 1) & 1U}
                   : Shifted{static_cast<std::uint32_t>(number >> 31), value >> 31};
}

Shifted ror(std::uint32_t value, std::uint32_t by, std::uint32_t carry) {
  const std::uint32_t turned = std::rotr(value, static_cast<int>(by % 32));
  return by == 0 ? Shifted{value, carry} : Shifted{turned, turned >> 31};
}

template <Second kSecond>
Shifted second(const Registers& x, const Instruction& in) {
  const std::uint32_t m = x.r[in.m];
  switch (kSecond) {
    case Second::Number:
      return {in.value, x.c};
    case Second::NumberAndFlag:
      return {in.value, in.value >> 31};
    case Second::Register:
      return {m, x.c};
    case Second::Lsl:
      return {m << in.value, m >> (32 - in.value) & 1U};
    case Second::Lsr:
      return lsr(m, in.value, x.c);
    case Second::Asr:
      return asr(m, in.value, x.c);
    case Second::Ror:
      return ror(m, in.value, x.c);
    case Second::Rrx:
      return {x.c << 31 | m >> 1, m & 1U};
  }
  return {};
}

// AddWithCarry of ARMv7-M ARM, A2.2.1.
template <bool kFlags>
std::uint32_t sum(Registers& x, std::uint32_t a, std::uint32_t b, std::uint32_t carry) {
  const std::uint32_t result = a + b + carry;
  if constexpr (kFlags) {
    x.n = result;
    x.z = result;
    x.c = static_cast<std::uint32_t>((std::uint64_t{a} + b + carry) >> 32);
    x.v = ~(a ^ b) & (a ^ result);
  }
  return result;
}

template <What kWhat, bool kFlags>
std::uint32_t sumOf(Registers& x, std::uint32_t a, std::uint32_t b) {
  switch (kWhat) {
    case What::Adc:
      return sum<kFlags>(x, a, b, x.c);
    case What::Sub:
    case What::Cmp:
      return sum<kFlags>(x, a, ~b, 1);
    case What::Sbc:
      return sum<kFlags>(x, a, ~b, x.c);
    case What::Rsb:
      return sum<kFlags>(x, ~a, b, 1);
    default:
      return sum<kFlags>(x, a, b, 0);
  }
}

template <What kWhat>
std::uint32_t logicOf(std::uint32_t a, std::uint32_t b) {
  switch (kWhat) {
    case What::And:
    case What::Tst:
      return a & b;
    case What::Bic:
      return a & ~b;
    case What::Orr:
      return a | b;
    case What::Orn:
      return a | ~b;
    case What::Eor:
    case What::Teq:
      return a ^ b;
    case What::Mvn:
      return ~b;
    default:
      return b;
  }
}

constexpr bool isSum(What what) {
  return what >= What::Add;
}

constexpr bool onlyCompares(What what) {
  return what == What::Tst || what == What::Teq || what == What::Cmp || what == What::Cmn;
}

template <What kWhat, Second kSecond, bool kFlags>
void process(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const Shifted b = second<kSecond>(x, in);
  std::uint32_t result = 0;
  if constexpr (isSum(kWhat)) {
    result = sumOf<kWhat, kFlags>(x, x.r[in.n], b.value);
  } else {
    result = logicOf<kWhat>(x.r[in.n], b.value);
    if constexpr (kFlags) {
      x.n = result;
      x.z = result;
      x.c = b.carry;
    }
  }
  if constexpr (!onlyCompares(kWhat)) {
    x.r[in.d] = result;
  }
}

// The stack pointer is a multiple of 4 (ARMv7-M ARM, B1.4.1).
template <What kWhat, Second kSecond>
void processStack(Core& core, const Instruction& in) {
  process<kWhat, kSecond, false>(core, in);
  core.registers.r[Registers::kStack] &= ~3U;
}

// ALUWritePC of A2.3.1.
template <What kWhat>
void processPc(Core& core, const Instruction& in) {
  const std::uint32_t before = core.registers.r[Registers::kPc];
  process<kWhat, Second::Register, false>(core, in);
  const std::uint32_t target = std::exchange(core.registers.r[Registers::kPc], before);
  core.branch(target);
}

template <std::size_t kIndex>
constexpr Instruction::Operation operationAt() {
  constexpr auto kWhat = static_cast<What>(kIndex / 2 / kSeconds);
  return process < kWhat, static_cast<Second>(kIndex / 2 % kSeconds),
         kIndex % 2 != 0 || onlyCompares(kWhat) > ;
}

template <std::size_t... kIndex>
constexpr auto operations(std::index_sequence<kIndex...> /*indices*/) {
  return std::array<Instruction::Operation, sizeof...(kIndex)>{operationAt<kIndex>()...};
}

constexpr auto kOperations = operations(std::make_index_sequence<kWhats * kSeconds * 2>());

Instruction::Operation operation(What what, Second second, bool flags) {
  const std::size_t row = static_cast<std::size_t>(what) * kSeconds;
  return kOperations[(row + static_cast<std::size_t>(second)) * 2 + (flags ? 1 : 0)];
}

template <Shifted (*kShift)(std::uint32_t, std::uint32_t, std::uint32_t), bool kFlags>
void shift(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const Shifted result = kShift(x.r[in.n], x.r[in.m] & 0xFFU, x.c);
  x.r[in.d] = result.value;
  if constexpr (kFlags) {
    x.n = result.value;
    x.z = result.value;
    x.c = result.carry;
  }
}

Instruction::Operation shiftOperation(unsigned type, bool flags) {
  constexpr std::array<std::array<Instruction::Operation, 2>, 4> kShifts{
      {{shift<lsl, false>, shift<lsl, true>},
       {shift<lsr, false>, shift<lsr, true>},
       {shift<asr, false>, shift<asr, true>},
       {shift<ror, false>, shift<ror, true>}}};
  return kShifts[type & 3U][flags ? 1 : 0];
}

/// A register that is shifted by a number in the instruction (A7.4.2, DecodeImmShift).
struct ShiftOfRegister {
  Second second;
  std::uint32_t by;
};

ShiftOfRegister shiftOfRegister(unsigned type, std::uint32_t by) {
  switch (type) {
    case 0:
      return {by == 0 ? Second::Register : Second::Lsl, by};
    case 1:
      return {Second::Lsr, by == 0 ? 32 : by};
    case 2:
      return {Second::Asr, by == 0 ? 32 : by};
    default:
      return {by == 0 ? Second::Rrx : Second::Ror, by};
  }
}

/// The operations of the 32-bit forms. A5.3.1 and A5.3.11 use the same numbers for the same
/// operations.
struct Choice {
  bool known;
  What what;
};

Choice choiceOf(Encoding code) {
  const bool compares = code.bit(20) && code.reg(8) == 15;
  const bool fromNothing = code.reg(16) == 15;
  switch (code.field(24, 21)) {
    case 0:
      return {true, compares ? What::Tst : What::And};
    case 1:
      return {true, What::Bic};
    case 2:
      return {true, fromNothing ? What::Mov : What::Orr};
    case 3:
      return {true, fromNothing ? What::Mvn : What::Orn};
    case 4:
      return {true, compares ? What::Teq : What::Eor};
    case 8:
      return {true, compares ? What::Cmn : What::Add};
    case 10:
      return {true, What::Adc};
    case 11:
      return {true, What::Sbc};
    case 13:
      return {true, compares ? What::Cmp : What::Sub};
    case 14:
      return {true, What::Rsb};
    default:
      return {false, What::And};
  }
}

// The result of ThumbExpandImm_C (ARMv7-M ARM, A5.3.2).
struct Expanded {
  std::uint32_t value;
  bool rotated;
};

Expanded expanded(Encoding code) {
  const std::uint32_t byte = code.field(7, 0);
  const std::uint32_t control = code.field(26, 26) << 4 | code.field(14, 12) << 1 | byte >> 7;
  switch (control >> 1) {
    case 0:
      return {byte, false};
    case 1:
      return {byte * 0x00010001U, false};
    case 2:
      return {byte * 0x01000100U, false};
    case 3:
      return {byte * 0x01010101U, false};
    default:
      return {std::rotr(0x80U | byte, static_cast<int>(control)), true};
  }
}

template <What kWhat>
Instruction::Operation stackOperation(Second second) {
  constexpr std::array<Instruction::Operation, kSeconds> kStack{
      processStack<kWhat, Second::Number>,   processStack<kWhat, Second::NumberAndFlag>,
      processStack<kWhat, Second::Register>, processStack<kWhat, Second::Lsl>,
      processStack<kWhat, Second::Lsr>,      processStack<kWhat, Second::Asr>,
      processStack<kWhat, Second::Ror>,      processStack<kWhat, Second::Rrx>};
  return kStack[static_cast<std::size_t>(second)];
}

Instruction longForm(Encoding code, Second second, std::uint32_t value) {
  const auto [known, what] = choiceOf(code);
  const std::uint8_t d = code.reg(8);
  if (!known || (d == 15 && !onlyCompares(what))) {
    return undefined();
  }
  Instruction result{.run = operation(what, second, code.bit(20)),
                     .value = value,
                     .d = d,
                     .n = code.reg(16),
                     .m = code.reg(0)};
  if (d == Registers::kStack && !code.bit(20)) {
    if (what == What::Add) {
      result.run = stackOperation<What::Add>(second);
    } else if (what == What::Sub) {
      result.run = stackOperation<What::Sub>(second);
    } else if (what == What::Mov) {
      result.run = stackOperation<What::Mov>(second);
    }
  }
  return result;
}

Instruction shortShiftOrSum(Encoding code) {
  const bool flags = !code.inBlock;
  const std::uint8_t d = code.low(0);
  const std::uint8_t n = code.low(3);
  if (code.field(13, 11) < 3) {
    const auto [second, by] = shiftOfRegister(code.field(12, 11), code.field(10, 6));
    return {.run = operation(What::Mov, second, flags), .value = by, .d = d, .m = n};
  }
  const What what = code.bit(9) ? What::Sub : What::Add;
  return {.run = operation(what, code.bit(10) ? Second::Number : Second::Register, flags),
          .value = code.field(8, 6),
          .d = d,
          .n = n,
          .m = code.low(6)};
}

Instruction shortNumber(Encoding code) {
  constexpr std::array kWhat{What::Mov, What::Cmp, What::Add, What::Sub};
  const std::uint8_t d = code.low(8);
  return {.run = operation(kWhat[code.field(12, 11)], Second::Number, !code.inBlock),
          .value = code.field(7, 0),
          .d = d,
          .n = d};
}

// A5.2.2
Instruction shortRegisters(Encoding code) {
  const std::uint8_t d = code.low(0);
  const std::uint8_t m = code.low(3);
  const bool flags = !code.inBlock;
  const auto two = [&](What what) {
    return Instruction{.run = operation(what, Second::Register, flags), .d = d, .n = d, .m = m};
  };
  switch (code.field(9, 6)) {
    case 0:
      return two(What::And);
    case 1:
      return two(What::Eor);
    case 2:
    case 3:
    case 4:
      return {.run = shiftOperation(code.field(9, 6) - 2, flags), .d = d, .n = d, .m = m};
    case 5:
      return two(What::Adc);
    case 6:
      return two(What::Sbc);
    case 7:
      return {.run = shiftOperation(3, flags), .d = d, .n = d, .m = m};
    case 8:
      return two(What::Tst);
    case 9:
      return {.run = operation(What::Rsb, Second::Number, flags), .value = 0, .d = d, .n = m};
    case 10:
      return two(What::Cmp);
    case 11:
      return two(What::Cmn);
    case 12:
      return two(What::Orr);
    case 13:
      return shortMultiply(code);
    case 14:
      return two(What::Bic);
    default:
      return two(What::Mvn);
  }
}

// A5.2.3, except BX and BLX
Instruction shortHighRegisters(Encoding code) {
  const auto d = static_cast<std::uint8_t>(code.low(0) | (code.bit(7) ? 8U : 0U));
  Instruction result{.d = d, .n = d, .m = code.reg(3)};
  const unsigned what = code.field(9, 8);
  if (what == 1) {
    result.run = operation(What::Cmp, Second::Register, true);
  } else if (d == Registers::kPc) {
    result.run = what == 0 ? processPc<What::Add> : processPc<What::Mov>;
  } else if (d == Registers::kStack) {
    result.run = what == 0 ? processStack<What::Add, Second::Register>
                           : processStack<What::Mov, Second::Register>;
  } else {
    result.run = operation(what == 0 ? What::Add : What::Mov, Second::Register, false);
  }
  return result;
}

void formAddress(Core& core, const Instruction& in) {
  core.registers.r[in.d] = (core.registers.r[Registers::kPc] & ~3U) + in.value;
}

}  // namespace

Instruction shortDataProcessing(Encoding code) {
  switch (code.field(15, 13)) {
    case 0:
      return shortShiftOrSum(code);
    case 1:
      return shortNumber(code);
    default:
      return code.bit(10) ? shortHighRegisters(code) : shortRegisters(code);
  }
}

Instruction dataProcessingImmediate(Encoding code) {
  const auto [value, rotated] = expanded(code);
  return longForm(code, rotated ? Second::NumberAndFlag : Second::Number, value);
}

Instruction dataProcessingRegister(Encoding code) {
  if (code.field(24, 21) == 6) {
    return packHalfwords(code);
  }
  const auto [second, by] =
      shiftOfRegister(code.field(5, 4), code.field(14, 12) << 2 | code.field(7, 6));
  return longForm(code, second, by);
}

Instruction addToStackPointer(std::uint8_t d, std::uint8_t n, std::uint32_t value) {
  return {.run = d == Registers::kStack ? processStack<What::Add, Second::Number>
                                        : operation(What::Add, Second::Number, false),
          .value = value,
          .d = d,
          .n = n};
}

Instruction addToPc(std::uint8_t d, std::uint32_t value) {
  return {.run = formAddress, .value = value, .d = d};
}

Instruction shiftByRegister(Encoding code) {
  return {.run = shiftOperation(code.field(22, 21), code.bit(20)),
          .d = code.reg(8),
          .n = code.reg(16),
          .m = code.reg(0)};
}

}  // namespace wr::emulator
