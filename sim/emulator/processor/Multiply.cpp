#include <limits>

#include "sim/emulator/processor/Core.hpp"
#include "sim/emulator/processor/Encoding.hpp"

// Products, sums of products, and quotients (ARMv7-M ARM, A5.3.16 and A5.3.17).

namespace wr::emulator {

namespace {

// The field `value` of an instruction contains the number of the register that is added. The lowest
// bits of this field select the form of the instruction.
constexpr std::uint32_t kFirstHigh = 1;   // upper half of the first operand
constexpr std::uint32_t kSecondHigh = 2;  // upper half of the second operand
constexpr std::uint32_t kExchanged = 2;   // halves of the second operand are swapped
constexpr std::uint32_t kRounded = 1;
constexpr unsigned kAddendShift = 8;

std::int64_t wide(std::uint32_t value) {
  return static_cast<std::int32_t>(value);
}

std::int64_t half(std::uint32_t value, bool high) {
  return static_cast<std::int16_t>(high ? value >> 16 : value);
}

std::uint32_t addend(const Core& core, const Instruction& in) {
  return core.registers.r[in.value >> kAddendShift];
}

// Returns the lower word of a sum. Sets Q when the sum does not fit into its register.
std::uint32_t narrowed(Core& core, std::int64_t value) {
  if (value != static_cast<std::int32_t>(value)) {
    core.registers.q = true;
  }
  return static_cast<std::uint32_t>(value);
}

template <bool kFlags>
void mul(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const std::uint32_t result = x.r[in.n] * x.r[in.m];
  x.r[in.d] = result;
  if constexpr (kFlags) {
    x.n = result;
    x.z = result;
  }
}

void mla(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  x.r[in.d] = addend(core, in) + x.r[in.n] * x.r[in.m];
}

void mls(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  x.r[in.d] = addend(core, in) - x.r[in.n] * x.r[in.m];
}

std::int64_t productOfHalves(const Core& core, const Instruction& in) {
  const Registers& x = core.registers;
  return half(x.r[in.n], (in.value & kFirstHigh) != 0) *
         half(x.r[in.m], (in.value & kSecondHigh) != 0);
}

void smulxy(Core& core, const Instruction& in) {
  core.registers.r[in.d] = static_cast<std::uint32_t>(productOfHalves(core, in));
}

void smlaxy(Core& core, const Instruction& in) {
  core.registers.r[in.d] = narrowed(core, productOfHalves(core, in) + wide(addend(core, in)));
}

std::int64_t productWithHalf(const Core& core, const Instruction& in) {
  const Registers& x = core.registers;
  return (wide(x.r[in.n]) * half(x.r[in.m], (in.value & kFirstHigh) != 0)) >> 16;
}

void smulw(Core& core, const Instruction& in) {
  core.registers.r[in.d] = static_cast<std::uint32_t>(productWithHalf(core, in));
}

void smlaw(Core& core, const Instruction& in) {
  core.registers.r[in.d] = narrowed(core, productWithHalf(core, in) + wide(addend(core, in)));
}

/// Returns the sum or the difference of two products. The factors of each product are one half of
/// the first operand and one half of the second operand.
template <bool kSubtracts>
std::int64_t dual(const Core& core, const Instruction& in) {
  const Registers& x = core.registers;
  const bool exchanged = (in.value & kExchanged) != 0;
  const std::int64_t low = half(x.r[in.n], false) * half(x.r[in.m], exchanged);
  const std::int64_t high = half(x.r[in.n], true) * half(x.r[in.m], !exchanged);
  return kSubtracts ? low - high : low + high;
}

template <bool kSubtracts, bool kAdds>
void dualProducts(Core& core, const Instruction& in) {
  const std::int64_t products = dual<kSubtracts>(core, in);
  core.registers.r[in.d] = narrowed(core, kAdds ? products + wide(addend(core, in)) : products);
}

template <bool kSubtracts, bool kAdds>
void mostSignificant(Core& core, const Instruction& in) {
  const Registers& x = core.registers;
  const auto product = static_cast<std::uint64_t>(wide(x.r[in.n]) * wide(x.r[in.m]));
  const std::uint64_t start = kAdds ? std::uint64_t{addend(core, in)} << 32 : 0;
  const std::uint64_t result = (kSubtracts ? start - product : start + product) +
                               ((in.value & kRounded) != 0 ? 0x80000000U : 0);
  core.registers.r[in.d] = static_cast<std::uint32_t>(result >> 32);
}

template <bool kAdds>
void sumOfDifferences(Core& core, const Instruction& in) {
  const Registers& x = core.registers;
  std::uint32_t sum = kAdds ? addend(core, in) : 0;
  for (unsigned shift = 0; shift < 32; shift += 8) {
    const std::uint32_t a = x.r[in.n] >> shift & 0xFFU;
    const std::uint32_t b = x.r[in.m] >> shift & 0xFFU;
    sum += a > b ? a - b : b - a;
  }
  core.registers.r[in.d] = sum;
}

// In a long product, register d receives the lower word. The field `value` contains the number of
// the register that receives the upper word.

std::uint64_t longAddend(const Core& core, const Instruction& in) {
  return std::uint64_t{addend(core, in)} << 32 | core.registers.r[in.d];
}

void setLong(Core& core, const Instruction& in, std::uint64_t value) {
  core.registers.r[in.d] = static_cast<std::uint32_t>(value);
  core.registers.r[in.value >> kAddendShift] = static_cast<std::uint32_t>(value >> 32);
}

template <bool kSigned, bool kAdds>
void longProduct(Core& core, const Instruction& in) {
  const std::uint32_t a = core.registers.r[in.n];
  const std::uint32_t b = core.registers.r[in.m];
  const std::uint64_t product =
      kSigned ? static_cast<std::uint64_t>(wide(a) * wide(b)) : std::uint64_t{a} * b;
  setLong(core, in, kAdds ? longAddend(core, in) + product : product);
}

void umaal(Core& core, const Instruction& in) {
  const Registers& x = core.registers;
  setLong(core, in,
          std::uint64_t{x.r[in.n]} * x.r[in.m] + addend(core, in) + core.registers.r[in.d]);
}

void smlalxy(Core& core, const Instruction& in) {
  setLong(core, in, longAddend(core, in) + static_cast<std::uint64_t>(productOfHalves(core, in)));
}

template <bool kSubtracts>
void longDual(Core& core, const Instruction& in) {
  setLong(core, in, longAddend(core, in) + static_cast<std::uint64_t>(dual<kSubtracts>(core, in)));
}

template <bool kSigned>
void divide(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const std::uint32_t dividend = x.r[in.n];
  const std::uint32_t divisor = x.r[in.m];
  core.spend(kDivideCycles);
  if (divisor == 0) {
    if (core.trapsDivideByZero) {
      core.trap(Trap::DivideByZero);
    } else {
      x.r[in.d] = 0;
    }
    return;
  }
  // If the most negative number is divided by -1, the result is this number itself. The 64-bit type
  // can represent the true quotient.
  x.r[in.d] =
      kSigned ? static_cast<std::uint32_t>(wide(dividend) / wide(divisor)) : dividend / divisor;
}

constexpr std::uint8_t kNoAddend = 15;

Instruction product(Encoding code, Instruction::Operation run, std::uint32_t form = 0) {
  return {.run = run,
          .value = std::uint32_t{code.reg(12)} << kAddendShift | form,
          .d = code.reg(8),
          .n = code.reg(16),
          .m = code.reg(0)};
}

Instruction longProductOf(Encoding code, Instruction::Operation run, std::uint32_t form = 0) {
  return {.run = run,
          .value = std::uint32_t{code.reg(8)} << kAddendShift | form,
          .d = code.reg(12),
          .n = code.reg(16),
          .m = code.reg(0)};
}

}  // namespace

Instruction shortMultiply(Encoding code) {
  return {.run = code.inBlock ? mul<false> : mul<true>,
          .d = code.low(0),
          .n = code.low(3),
          .m = code.low(0)};
}

Instruction multiply(Encoding code) {
  const bool adds = code.reg(12) != kNoAddend;
  const bool upper = code.bit(5);
  const std::uint32_t halves = (code.bit(5) ? kFirstHigh : 0) | (code.bit(4) ? kSecondHigh : 0);
  const std::uint32_t exchanged = code.bit(4) ? kExchanged : 0;
  const std::uint32_t rounded = code.bit(4) ? kRounded : 0;
  if (code.field(7, 6) != 0) {
    return undefined();
  }
  switch (code.field(22, 20)) {
    case 0:
      if (upper) {
        return undefined();
      }
      return code.bit(4) ? product(code, mls) : product(code, adds ? mla : mul<false>);
    case 1:
      return product(code, adds ? smlaxy : smulxy, halves);
    case 2:
      return upper ? undefined()
                   : product(code, adds ? dualProducts<false, true> : dualProducts<false, false>,
                             exchanged);
    case 3:
      return upper ? undefined()
                   : product(code, adds ? smlaw : smulw, code.bit(4) ? kFirstHigh : 0);
    case 4:
      return upper ? undefined()
                   : product(code, adds ? dualProducts<true, true> : dualProducts<true, false>,
                             exchanged);
    case 5:
      return upper ? undefined()
                   : product(code,
                             adds ? mostSignificant<false, true> : mostSignificant<false, false>,
                             rounded);
    case 6:
      return upper ? undefined() : product(code, mostSignificant<true, true>, rounded);
    default:
      return code.field(5, 4) != 0
                 ? undefined()
                 : product(code, adds ? sumOfDifferences<true> : sumOfDifferences<false>);
  }
}

Instruction longMultiply(Encoding code) {
  const unsigned form = code.field(7, 4);
  const std::uint32_t halves = (code.bit(5) ? kFirstHigh : 0) | (code.bit(4) ? kSecondHigh : 0);
  const std::uint32_t exchanged = code.bit(4) ? kExchanged : 0;
  switch (code.field(22, 20) << 4 | form) {
    case 0x00:
      return longProductOf(code, longProduct<true, false>);
    case 0x1F:
      return product(code, divide<true>);
    case 0x20:
      return longProductOf(code, longProduct<false, false>);
    case 0x3F:
      return product(code, divide<false>);
    case 0x40:
      return longProductOf(code, longProduct<true, true>);
    case 0x48:
    case 0x49:
    case 0x4A:
    case 0x4B:
      return longProductOf(code, smlalxy, halves);
    case 0x4C:
    case 0x4D:
      return longProductOf(code, longDual<false>, exchanged);
    case 0x5C:
    case 0x5D:
      return longProductOf(code, longDual<true>, exchanged);
    case 0x60:
      return longProductOf(code, longProduct<false, true>);
    case 0x66:
      return longProductOf(code, umaal);
    default:
      return undefined();
  }
}

}  // namespace wr::emulator
