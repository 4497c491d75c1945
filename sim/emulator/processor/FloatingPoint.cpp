#include <array>
#include <span>

#include "sim/emulator/processor/Core.hpp"
#include "sim/emulator/processor/Encoding.hpp"
#include "sim/emulator/processor/Float.hpp"

// The floating-point extension FPv4-SP (ARMv7-M ARM, A6.4 to A6.7). The fields `d`, `n` and `m` are
// numbers of single-precision registers.

namespace wr::emulator {

namespace {

template <Instruction::Operation kOperation>
void checked(Core& core, const Instruction& in) {
  if (core.beginFp()) {
    kOperation(core, in);
  }
}

// Returns the number of a single-precision register. The encoding has the lowest bit of the number
// in a separate field (A6.2).
std::uint8_t single(Encoding code, unsigned high, unsigned low) {
  return static_cast<std::uint8_t>(code.field(high + 3, high) << 1 | code.field(low, low));
}

Instruction ofSingles(Encoding code, Instruction::Operation run, std::uint32_t value = 0) {
  return {.run = run,
          .value = value,
          .d = single(code, 12, 22),
          .n = single(code, 16, 7),
          .m = single(code, 0, 5)};
}

void noCoprocessor(Core& core, const Instruction& /*in*/) {
  core.trap(Trap::NoCoprocessor);
}

// While the floating-point unit is on, an instruction is undefined if this unit does not have it.
void unknown(Core& core, const Instruction& /*in*/) {
  core.trap(Trap::Undefined);
}

Instruction unknownFp() {
  return {.run = checked<unknown>};
}

// Arithmetic, A6.4.

template <bool kNegatesProduct, bool kNegatesSum>
void multiplyAccumulate(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  Float unit(x.fpscr);
  core.spend(kFpAccumulateCycles);
  const std::uint32_t product = unit.multiply(x.s[in.n], x.s[in.m]);
  const std::uint32_t sum = x.s[in.d] ^ (kNegatesSum ? Float::kSign : 0);
  x.s[in.d] = unit.add(sum, product ^ (kNegatesProduct ? Float::kSign : 0));
}

template <bool kNegatesProduct, bool kNegatesSum>
void fusedMultiplyAccumulate(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  core.spend(kFpAccumulateCycles);
  x.s[in.d] =
      Float(x.fpscr).multiplyAdd(x.s[in.d] ^ (kNegatesSum ? Float::kSign : 0),
                                 x.s[in.n] ^ (kNegatesProduct ? Float::kSign : 0), x.s[in.m]);
}

template <bool kNegates>
void multiplySingles(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  x.s[in.d] = Float(x.fpscr).multiply(x.s[in.n], x.s[in.m]) ^ (kNegates ? Float::kSign : 0);
}

void addSingles(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  x.s[in.d] = Float(x.fpscr).add(x.s[in.n], x.s[in.m]);
}

// FPSub cannot be replaced by FPAdd with a negated operand, because FPSub keeps the sign of a NaN.
void subtractSingles(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  x.s[in.d] = Float(x.fpscr).subtract(x.s[in.n], x.s[in.m]);
}

void divideSingles(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  core.spend(kFpDivideCycles);
  x.s[in.d] = Float(x.fpscr).divide(x.s[in.n], x.s[in.m]);
}

void squareRoot(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  core.spend(kFpDivideCycles);
  x.s[in.d] = Float(x.fpscr).squareRoot(x.s[in.m]);
}

void setNumber(Core& core, const Instruction& in) {
  core.registers.s[in.d] = in.value;
}

void copy(Core& core, const Instruction& in) {
  core.registers.s[in.d] = core.registers.s[in.m];
}

void absolute(Core& core, const Instruction& in) {
  core.registers.s[in.d] = core.registers.s[in.m] & ~Float::kSign;
}

void negate(Core& core, const Instruction& in) {
  core.registers.s[in.d] = core.registers.s[in.m] ^ Float::kSign;
}

// Compares two numbers. Bit 0 of `value` means a comparison with zero. Bit 1 means that each NaN is
// invalid.
void compare(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const std::uint32_t other = (in.value & 1U) != 0 ? 0 : x.s[in.m];
  Float(x.fpscr).compare(x.s[in.d], other, (in.value & 2U) != 0);
}

// Converts the lower half of a register, or the upper half if `value` is 16.
void fromHalf(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  x.s[in.d] = Float(x.fpscr).fromHalf(x.s[in.m] >> in.value & 0xFFFFU);
}

void toHalf(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const std::uint32_t half = Float(x.fpscr).toHalf(x.s[in.m]);
  x.s[in.d] = (x.s[in.d] & ~(0xFFFFU << in.value)) | half << in.value;
}

// In a conversion, the lower 8 bits of `value` contain the number of fraction bits. The next bits
// are options of the conversion.
constexpr std::uint32_t kSignedFixed = 0x100;
constexpr std::uint32_t kHalfFixed = 0x200;
constexpr std::uint32_t kGivenRounding =
    0x400;  // the instruction determines the rounding; FPSCR does not

Float::Fixed fixedOf(const Instruction& in) {
  return {.bits = (in.value & kHalfFixed) != 0 ? 16U : 32U,
          .fraction = in.value & 0xFFU,
          .isSigned = (in.value & kSignedFixed) != 0};
}

void toFixed(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  x.s[in.d] = Float(x.fpscr).toFixed(x.s[in.m], fixedOf(in), (in.value & kGivenRounding) != 0);
}

void fromFixed(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  x.s[in.d] = Float(x.fpscr).fromFixed(x.s[in.m], fixedOf(in), (in.value & kGivenRounding) != 0);
}

// VFPExpandImm of A6.4.1.
std::uint32_t expandedNumber(Encoding code) {
  const std::uint32_t byte = code.field(19, 16) << 4 | code.field(3, 0);
  const std::uint32_t exponent = (byte & 0x40U) != 0 ? 0x3E000000U : 0x40000000U;
  return (byte & 0x80U) << 24 | exponent | (byte & 0x3FU) << 19;
}

Instruction fixedConversion(Encoding code) {
  const bool isHalf = !code.bit(7);
  const std::uint32_t size = isHalf ? 16 : 32;
  const std::uint32_t place = code.field(3, 0) << 1 | code.field(5, 5);
  if (place > size) {
    return unknownFp();
  }
  Instruction result = ofSingles(code, code.bit(18) ? checked<toFixed> : checked<fromFixed>,
                                 (size - place) | (code.bit(16) ? 0 : kSignedFixed) |
                                     (isHalf ? kHalfFixed : 0) | kGivenRounding);
  result.m = result.d;
  return result;
}

// Decodes the rows with opc1 1x11 of table A6-4.
Instruction otherData(Encoding code) {
  if (!code.bit(6)) {
    return ofSingles(code, checked<setNumber>, expandedNumber(code));
  }
  const bool upper = code.bit(7);
  switch (code.field(19, 16)) {
    case 0b0000:
      return ofSingles(code, upper ? checked<absolute> : checked<copy>);
    case 0b0001:
      return ofSingles(code, upper ? checked<squareRoot> : checked<negate>);
    case 0b0010:
      return ofSingles(code, checked<fromHalf>, upper ? 16 : 0);
    case 0b0011:
      return ofSingles(code, checked<toHalf>, upper ? 16 : 0);
    case 0b0100:
      return ofSingles(code, checked<compare>, upper ? 2 : 0);
    case 0b0101:
      return ofSingles(code, checked<compare>, upper ? 3 : 1);
    case 0b1000:
      return ofSingles(code, checked<fromFixed>, upper ? kSignedFixed : 0);
    case 0b1010:
    case 0b1011:
    case 0b1110:
    case 0b1111:
      return fixedConversion(code);
    case 0b1100:
      return ofSingles(code, checked<toFixed>, upper ? kGivenRounding : 0);
    case 0b1101:
      return ofSingles(code, checked<toFixed>, kSignedFixed | (upper ? kGivenRounding : 0));
    default:
      return unknownFp();
  }
}

Instruction floatingPointData(Encoding code) {
  const bool other = code.bit(6);
  switch (code.field(23, 20) & 0b1011U) {
    case 0b0000:
      return ofSingles(code, other ? checked<multiplyAccumulate<true, false>>
                                   : checked<multiplyAccumulate<false, false>>);
    case 0b0001:
      return ofSingles(code, other ? checked<multiplyAccumulate<true, true>>
                                   : checked<multiplyAccumulate<false, true>>);
    case 0b0010:
      return ofSingles(code,
                       other ? checked<multiplySingles<true>> : checked<multiplySingles<false>>);
    case 0b0011:
      return ofSingles(code, other ? checked<subtractSingles> : checked<addSingles>);
    case 0b1000:
      return other ? unknownFp() : ofSingles(code, checked<divideSingles>);
    case 0b1001:
      return ofSingles(code, other ? checked<fusedMultiplyAccumulate<true, true>>
                                   : checked<fusedMultiplyAccumulate<false, true>>);
    case 0b1010:
      return ofSingles(code, other ? checked<fusedMultiplyAccumulate<true, false>>
                                   : checked<fusedMultiplyAccumulate<false, false>>);
    default:
      return otherData(code);
  }
}

// Loads and stores, A6.5. The field `value` is the offset. The field `m` is the number of
// single-precision registers.

constexpr std::uint8_t kDoubleWord = 2;

std::uint32_t fpBase(const Registers& x, const Instruction& in) {
  return in.n == Registers::kPc ? x.r[in.n] & ~3U : x.r[in.n];
}

template <bool kLoads>
bool transfer(Core& core, std::uint32_t address, unsigned first, unsigned count) {
  const std::span<std::uint32_t> singles = std::span(core.registers.s).subspan(first, count);
  return kLoads ? core.loadWords(address, singles) : core.storeWords(address, singles);
}

template <bool kLoads>
void loadStoreSingles(Core& core, const Instruction& in) {
  core.spend(in.m);
  (void)transfer<kLoads>(core, fpBase(core.registers, in) + in.value, in.d, in.m);
}

// Loads or stores several registers. If bit 0 of `value` is set, register n is written back. If bit
// 1 is set, register n is decremented first.
template <bool kLoads>
void loadStoreMany(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const std::uint32_t size = 4U * in.m + (in.value & 4U);  // FLDMX has one more word
  const std::uint32_t base = fpBase(x, in);
  const bool down = (in.value & 2U) != 0;
  core.spend(in.m);
  if (transfer<kLoads>(core, down ? base - size : base, in.d, in.m) && (in.value & 1U) != 0) {
    x.r[in.n] = down ? base - size : base + size;
  }
}

std::uint8_t firstOf(Encoding code, bool isDouble) {
  return isDouble ? static_cast<std::uint8_t>(code.field(15, 12) * 2) : single(code, 12, 22);
}

Instruction fpLoadStore(Encoding code) {
  const bool isDouble = code.bit(8);
  const std::uint32_t count = code.field(7, 0);
  const bool loads = code.bit(20);
  Instruction result{.d = firstOf(code, isDouble), .n = code.reg(16)};
  if (isDouble && code.bit(22)) {
    return unknownFp();  // registers above D15
  }
  if (code.bit(24) && !code.bit(21)) {
    result.run = loads ? checked<loadStoreSingles<true>> : checked<loadStoreSingles<false>>;
    result.value = code.bit(23) ? count * 4 : 0 - count * 4;
    result.m = isDouble ? kDoubleWord : 1;
    return result;
  }
  const bool down = code.bit(24);
  if (down == code.bit(23) || count == 0 || result.d + (isDouble ? count & ~1U : count) > 32) {
    return unknownFp();
  }
  result.run = loads ? checked<loadStoreMany<true>> : checked<loadStoreMany<false>>;
  result.m = static_cast<std::uint8_t>(isDouble ? count & ~1U : count);
  result.value =
      (code.bit(21) ? 1U : 0) | (down ? 2U : 0) | (isDouble && (count & 1U) != 0 ? 4U : 0);
  return result;
}

// Moves, A6.6 and A6.7: d and n are core registers, m is a single-precision register.

void fromCore(Core& core, const Instruction& in) {
  core.registers.s[in.m] = core.registers.r[in.d];
}

void toCore(Core& core, const Instruction& in) {
  core.registers.r[in.d] = core.registers.s[in.m];
}

void twoFromCore(Core& core, const Instruction& in) {
  core.spend(1);
  core.registers.s[in.m] = core.registers.r[in.d];
  core.registers.s[in.m + 1U] = core.registers.r[in.n];
}

void twoToCore(Core& core, const Instruction& in) {
  core.spend(1);
  core.registers.r[in.d] = core.registers.s[in.m];
  core.registers.r[in.n] = core.registers.s[in.m + 1U];
}

void setStatus(Core& core, const Instruction& in) {
  core.registers.fpscr = core.registers.r[in.d] & 0xF7C0009FU;
}

void getStatus(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  if (in.d == Registers::kPc) {
    x.setFlags((x.fpscr & 0xF0000000U) | (x.q ? 1U << 27 : 0));
  } else {
    x.r[in.d] = x.fpscr;
  }
}

Instruction twoRegisters(Encoding code) {
  const bool isDouble = code.bit(8);
  const std::uint8_t first =
      isDouble ? static_cast<std::uint8_t>(code.field(3, 0) * 2) : single(code, 0, 5);
  if (code.field(7, 6) != 0 || !code.bit(4) || (isDouble && code.bit(5)) || first > 30) {
    return unknownFp();
  }
  return {.run = code.bit(20) ? checked<twoToCore> : checked<twoFromCore>,
          .d = code.reg(12),
          .n = code.reg(16),
          .m = first};
}

Instruction floatingPointMove(Encoding code) {
  Instruction result{.d = code.reg(12), .m = single(code, 16, 7)};
  const bool toTheCore = code.bit(20);
  if (code.bit(8)) {  // one half of a double-precision register
    if (code.field(6, 5) != 0 || code.bit(7) || code.field(23, 22) != 0) {
      return unknownFp();
    }
    result.m = static_cast<std::uint8_t>(code.field(19, 16) * 2 + code.field(21, 21));
    result.run = toTheCore ? checked<toCore> : checked<fromCore>;
    return result;
  }
  switch (code.field(23, 21)) {
    case 0:
      result.run = toTheCore ? checked<toCore> : checked<fromCore>;
      return result;
    case 7:
      if (code.field(19, 16) != 1) {
        return unknownFp();
      }
      result.run = toTheCore ? checked<getStatus> : checked<setStatus>;
      return result;
    default:
      return unknownFp();
  }
}

}  // namespace

Instruction coprocessor(Encoding code) {
  if (code.field(25, 24) == 3 || code.field(25, 21) == 0) {
    return undefined();
  }
  if (code.field(11, 9) != 5) {
    return {.run = noCoprocessor};
  }
  if (code.bit(28)) {
    return unknownFp();
  }
  if (!code.bit(25)) {
    return code.field(24, 21) == 2 ? twoRegisters(code) : fpLoadStore(code);
  }
  if (code.bit(4)) {
    return floatingPointMove(code);
  }
  return code.bit(8) ? unknownFp() : floatingPointData(code);
}

}  // namespace wr::emulator
