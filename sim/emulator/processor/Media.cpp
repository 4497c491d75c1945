#include <algorithm>
#include <array>
#include <bit>

#include "sim/emulator/processor/Core.hpp"
#include "sim/emulator/processor/Encoding.hpp"

// Instructions for parts of words: fields, bytes, half-words, saturation (ARMv7-M ARM, A5.2.5,
// A5.3.3, A5.3.12 to A5.3.15).

namespace wr::emulator {

namespace {

std::uint32_t ones(unsigned count) {
  return count >= 32 ? ~0U : (1U << count) - 1;
}

std::int32_t signedHalf(std::uint32_t value, unsigned shift) {
  return static_cast<std::int16_t>(value >> shift);
}

std::int32_t signedByte(std::uint32_t value, unsigned shift) {
  return static_cast<std::int8_t>(value >> shift);
}

// SignedSatQ and UnsignedSatQ of A2.2.1. These functions do not set Q.
std::int64_t saturated(std::int64_t value, unsigned bits) {
  const std::int64_t most = (std::int64_t{1} << (bits - 1)) - 1;
  return std::clamp(value, -most - 1, most);
}

std::int64_t saturatedUnsigned(std::int64_t value, unsigned bits) {
  return std::clamp<std::int64_t>(value, 0, (std::int64_t{1} << bits) - 1);
}

// Immediate numbers and fields, A5.3.3.

void mov(Core& core, const Instruction& in) {
  core.registers.r[in.d] = in.value;
}

void movt(Core& core, const Instruction& in) {
  std::uint32_t& d = core.registers.r[in.d];
  d = (d & 0xFFFFU) | in.value << 16;
}

// In an instruction for a bit field, `value` is the lowest bit and `m` is the width.

template <bool kSigned>
void extractField(Core& core, const Instruction& in) {
  const std::uint32_t field = core.registers.r[in.n] << (32 - in.value - in.m);
  const unsigned shift = 32U - in.m;
  core.registers.r[in.d] =
      kSigned ? static_cast<std::uint32_t>(static_cast<std::int32_t>(field) >> shift)
              : field >> shift;
}

template <bool kClears>
void insertField(Core& core, const Instruction& in) {
  const std::uint32_t mask = ones(in.m) << in.value;
  const std::uint32_t field = kClears ? 0 : core.registers.r[in.n] << in.value;
  std::uint32_t& d = core.registers.r[in.d];
  d = (d & ~mask) | (field & mask);
}

// In a saturation, `m` is the number of bits, and `value` is a shift to the left. If bit 8 of
// `value` is set, the shift is to the right.
constexpr std::uint32_t kToTheRight = 0x100;

template <bool kSigned>
void saturate(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const auto number = static_cast<std::int32_t>(x.r[in.n]);
  const unsigned by = in.value & 0x1FU;
  const std::int32_t shifted =
      (in.value & kToTheRight) != 0 ? number >> by : static_cast<std::int32_t>(x.r[in.n] << by);
  const std::int64_t result = kSigned ? saturated(shifted, in.m) : saturatedUnsigned(shifted, in.m);
  x.q = x.q || result != shifted;
  x.r[in.d] = static_cast<std::uint32_t>(result);
}

template <bool kSigned>
void saturateHalves(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  std::uint32_t word = 0;
  for (unsigned shift = 0; shift < 32; shift += 16) {
    const std::int32_t half = signedHalf(x.r[in.n], shift);
    const std::int64_t result = kSigned ? saturated(half, in.m) : saturatedUnsigned(half, in.m);
    x.q = x.q || result != half;
    word |= (static_cast<std::uint32_t>(result) & 0xFFFFU) << shift;
  }
  x.r[in.d] = word;
}

Instruction saturation(Encoding code) {
  const bool isSigned = !code.bit(23);
  const bool right = code.bit(21);
  const std::uint32_t by = code.field(14, 12) << 2 | code.field(7, 6);
  const auto bits = static_cast<std::uint8_t>(code.field(4, 0) + (isSigned ? 1 : 0));
  if (right && by == 0) {
    return {.run = isSigned ? saturateHalves<true> : saturateHalves<false>,
            .d = code.reg(8),
            .n = code.reg(16),
            .m = static_cast<std::uint8_t>(code.field(3, 0) + (isSigned ? 1 : 0))};
  }
  return {.run = isSigned ? saturate<true> : saturate<false>,
          .value = by | (right ? kToTheRight : 0),
          .d = code.reg(8),
          .n = code.reg(16),
          .m = bits};
}

Instruction fieldOperation(Encoding code) {
  const std::uint32_t lowest = code.field(14, 12) << 2 | code.field(7, 6);
  const unsigned last = code.field(4, 0);
  const bool inserts = code.field(24, 20) == 22;
  const unsigned width = inserts ? last + 1 - lowest : last + 1;
  if (width == 0 || width > 32 - lowest) {
    return undefined();
  }
  Instruction result{
      .value = lowest, .d = code.reg(8), .n = code.reg(16), .m = static_cast<std::uint8_t>(width)};
  if (inserts) {
    result.run = result.n == 15 ? insertField<true> : insertField<false>;
  } else {
    result.run = code.bit(23) ? extractField<false> : extractField<true>;
  }
  return result;
}

// In an extension, `value` is the rotation, and register n is added.

enum class Part : std::uint8_t { SignedHalf, Half, SignedBytes, Bytes, SignedByte, Byte };

template <Part kPart>
std::uint32_t part(std::uint32_t value) {
  switch (kPart) {
    case Part::SignedHalf:
      return static_cast<std::uint32_t>(signedHalf(value, 0));
    case Part::Half:
      return value & 0xFFFFU;
    case Part::SignedBytes:
      return (static_cast<std::uint32_t>(signedByte(value, 0)) & 0xFFFFU) |
             static_cast<std::uint32_t>(signedByte(value, 16)) << 16;
    case Part::Bytes:
      return value & 0x00FF00FFU;
    case Part::SignedByte:
      return static_cast<std::uint32_t>(signedByte(value, 0));
    case Part::Byte:
      return value & 0xFFU;
  }
  return 0;
}

template <Part kPart, bool kAdds>
void extendPart(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const std::uint32_t extended = part<kPart>(std::rotr(x.r[in.m], static_cast<int>(in.value)));
  if constexpr (!kAdds) {
    x.r[in.d] = extended;
  } else if constexpr (kPart == Part::SignedBytes || kPart == Part::Bytes) {
    const std::uint32_t a = x.r[in.n];
    x.r[in.d] = ((a + extended) & 0xFFFFU) | ((a & 0xFFFF0000U) + (extended & 0xFFFF0000U));
  } else {
    x.r[in.d] = x.r[in.n] + extended;
  }
}

template <Part kPart>
Instruction::Operation extension(bool adds) {
  return adds ? extendPart<kPart, true> : extendPart<kPart, false>;
}

void rev(Core& core, const Instruction& in) {
  core.registers.r[in.d] = __builtin_bswap32(core.registers.r[in.m]);
}

void rev16(Core& core, const Instruction& in) {
  core.registers.r[in.d] = std::rotl(__builtin_bswap32(core.registers.r[in.m]), 16);
}

void revsh(Core& core, const Instruction& in) {
  const std::uint32_t turned = std::rotl(__builtin_bswap32(core.registers.r[in.m]), 16);
  core.registers.r[in.d] = static_cast<std::uint32_t>(signedHalf(turned, 0));
}

void rbit(Core& core, const Instruction& in) {
  std::uint32_t value = core.registers.r[in.m];
  std::uint32_t turned = 0;
  for (unsigned i = 0; i < 32; ++i) {
    turned = turned << 1 | (value & 1U);
    value >>= 1;
  }
  core.registers.r[in.d] = turned;
}

void clz(Core& core, const Instruction& in) {
  core.registers.r[in.d] = static_cast<std::uint32_t>(std::countl_zero(core.registers.r[in.m]));
}

void sel(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  std::uint32_t mask = 0;
  for (unsigned i = 0; i < 4; ++i) {
    mask |= (x.ge >> i & 1U) != 0 ? 0xFFU << 8 * i : 0;
  }
  x.r[in.d] = (x.r[in.n] & mask) | (x.r[in.m] & ~mask);
}

// In QADD and similar instructions, register m is the first operand, and register n may be doubled.
template <bool kDoubles, bool kSubtracts>
void saturatingSum(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  std::int64_t other = static_cast<std::int32_t>(x.r[in.n]);
  if constexpr (kDoubles) {
    const std::int64_t doubled = saturated(2 * other, 32);
    x.q = x.q || doubled != 2 * other;
    other = doubled;
  }
  const std::int64_t first = static_cast<std::int32_t>(x.r[in.m]);
  const std::int64_t exact = kSubtracts ? first - other : first + other;
  const std::int64_t result = saturated(exact, 32);
  x.q = x.q || result != exact;
  x.r[in.d] = static_cast<std::uint32_t>(result);
}

// Parallel sums, A5.3.13 and A5.3.14.

enum class Lanes : std::uint8_t { Bytes, Halves, AddSubtract, SubtractAdd };
enum class Result : std::uint8_t { Wraps, Saturates, Halves };

std::int32_t lane(std::uint32_t word, unsigned shift, bool isSigned, unsigned bits) {
  const std::uint32_t field = word >> shift & ones(bits);
  if (!isSigned) {
    return static_cast<std::int32_t>(field);
  }
  return bits == 8 ? signedByte(field, 0) : signedHalf(field, 0);
}

template <Lanes kLanes, Result kResult, bool kSigned, bool kSubtracts>
void parallel(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  constexpr unsigned kBits = kLanes == Lanes::Bytes ? 8 : 16;
  constexpr bool kExchanges = kLanes == Lanes::AddSubtract || kLanes == Lanes::SubtractAdd;
  std::uint32_t word = 0;
  unsigned ge = 0;
  for (unsigned shift = 0; shift < 32; shift += kBits) {
    // ASX adds the upper half and subtracts the lower half. SAX does the reverse.
    const bool subtracts = kExchanges ? (shift == 0) == (kLanes == Lanes::AddSubtract) : kSubtracts;
    const std::int32_t a = lane(x.r[in.n], shift, kSigned, kBits);
    const std::int32_t b = lane(x.r[in.m], kExchanges ? 16 - shift : shift, kSigned, kBits);
    const std::int32_t exact = subtracts ? a - b : a + b;
    std::int64_t result = exact;
    if constexpr (kResult == Result::Saturates) {
      result = kSigned ? saturated(exact, kBits) : saturatedUnsigned(exact, kBits);
    } else if constexpr (kResult == Result::Halves) {
      result = exact >> 1;
    }
    const bool greater = kSigned || subtracts ? exact >= 0 : exact >> kBits != 0;
    ge |= greater ? ones(kBits / 8) << shift / 8 : 0;
    word |= (static_cast<std::uint32_t>(result) & ones(kBits)) << shift;
  }
  if constexpr (kResult == Result::Wraps) {
    x.ge = static_cast<std::uint8_t>(ge);
  }
  x.r[in.d] = word;
}

template <Lanes kLanes, bool kSubtracts>
Instruction::Operation parallelOf(Result result, bool isSigned) {
  switch (result) {
    case Result::Wraps:
      return isSigned ? parallel<kLanes, Result::Wraps, true, kSubtracts>
                      : parallel<kLanes, Result::Wraps, false, kSubtracts>;
    case Result::Saturates:
      return isSigned ? parallel<kLanes, Result::Saturates, true, kSubtracts>
                      : parallel<kLanes, Result::Saturates, false, kSubtracts>;
    case Result::Halves:
      return isSigned ? parallel<kLanes, Result::Halves, true, kSubtracts>
                      : parallel<kLanes, Result::Halves, false, kSubtracts>;
  }
  return nullptr;
}

template <bool kTopFirst>
void pack(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const std::uint32_t n = x.r[in.n];
  if constexpr (kTopFirst) {  // PKHTB takes the lower half from register m, shifted to the right
    const auto m = static_cast<std::uint32_t>(
        static_cast<std::int64_t>(static_cast<std::int32_t>(x.r[in.m])) >> in.value);
    x.r[in.d] = (n & 0xFFFF0000U) | (m & 0xFFFFU);
  } else {
    x.r[in.d] = (n & 0xFFFFU) | (x.r[in.m] << in.value & 0xFFFF0000U);
  }
}

Instruction three(Encoding code, Instruction::Operation run) {
  return {.run = run, .d = code.reg(8), .n = code.reg(16), .m = code.reg(0)};
}

}  // namespace

Instruction plainImmediate(Encoding code) {
  const std::uint32_t number =
      code.field(26, 26) << 11 | code.field(14, 12) << 8 | code.field(7, 0);
  const std::uint8_t d = code.reg(8);
  const std::uint8_t n = code.reg(16);
  switch (code.field(24, 20)) {
    case 0:
      return n == 15 ? addToPc(d, number) : addToStackPointer(d, n, number);
    case 10:
      return n == 15 ? addToPc(d, 0 - number) : addToStackPointer(d, n, 0 - number);
    case 4:
      return {.run = mov, .value = std::uint32_t{n} << 12 | number, .d = d};
    case 12:
      return {.run = movt, .value = std::uint32_t{n} << 12 | number, .d = d};
    case 16:
    case 18:
    case 24:
    case 26:
      return saturation(code);
    case 20:
    case 22:
    case 28:
      return fieldOperation(code);
    default:
      return undefined();
  }
}

Instruction shortExtendOrReverse(Encoding code) {
  Instruction result{.d = code.low(0), .m = code.low(3)};
  constexpr std::array<Instruction::Operation, 4> kExtend{
      extendPart<Part::SignedHalf, false>, extendPart<Part::SignedByte, false>,
      extendPart<Part::Half, false>, extendPart<Part::Byte, false>};
  constexpr std::array<Instruction::Operation, 4> kReverse{rev, rev16, nullptr, revsh};
  result.run = (code.bit(11) ? kReverse : kExtend)[code.field(7, 6)];
  return result.run == nullptr ? undefined() : result;
}

Instruction extend(Encoding code) {
  const bool adds = code.reg(16) != 15;
  Instruction result{
      .value = code.field(5, 4) * 8, .d = code.reg(8), .n = code.reg(16), .m = code.reg(0)};
  switch (code.field(22, 20)) {
    case 0:
      result.run = extension<Part::SignedHalf>(adds);
      return result;
    case 1:
      result.run = extension<Part::Half>(adds);
      return result;
    case 2:
      result.run = extension<Part::SignedBytes>(adds);
      return result;
    case 3:
      result.run = extension<Part::Bytes>(adds);
      return result;
    case 4:
      result.run = extension<Part::SignedByte>(adds);
      return result;
    case 5:
      result.run = extension<Part::Byte>(adds);
      return result;
    default:
      return undefined();
  }
}

Instruction parallelAddition(Encoding code) {
  if (code.field(5, 4) == 3) {
    return undefined();
  }
  const auto result = static_cast<Result>(code.field(5, 4));
  const bool isSigned = !code.bit(6);
  switch (code.field(22, 20)) {
    case 0:
      return three(code, parallelOf<Lanes::Bytes, false>(result, isSigned));
    case 1:
      return three(code, parallelOf<Lanes::Halves, false>(result, isSigned));
    case 2:
      return three(code, parallelOf<Lanes::AddSubtract, false>(result, isSigned));
    case 4:
      return three(code, parallelOf<Lanes::Bytes, true>(result, isSigned));
    case 5:
      return three(code, parallelOf<Lanes::Halves, true>(result, isSigned));
    case 6:
      return three(code, parallelOf<Lanes::SubtractAdd, false>(result, isSigned));
    default:
      return undefined();
  }
}

Instruction miscellaneous(Encoding code) {
  constexpr std::array<Instruction::Operation, 4> kSums{
      saturatingSum<false, false>, saturatingSum<true, false>, saturatingSum<false, true>,
      saturatingSum<true, true>};
  constexpr std::array<Instruction::Operation, 4> kReverse{rev, rev16, rbit, revsh};
  const unsigned which = code.field(5, 4);
  switch (code.field(22, 20)) {
    case 0:
      return three(code, kSums[which]);
    case 1:
      return three(code, kReverse[which]);
    case 2:
      return which == 0 ? three(code, sel) : undefined();
    case 3:
      return which == 0 ? three(code, clz) : undefined();
    default:
      return undefined();
  }
}

Instruction packHalfwords(Encoding code) {
  const std::uint32_t by = code.field(14, 12) << 2 | code.field(7, 6);
  if (code.bit(20) || code.bit(4)) {
    return undefined();
  }
  Instruction result = three(code, code.bit(5) ? pack<true> : pack<false>);
  result.value = code.bit(5) && by == 0 ? 32 : by;
  return result;
}

}  // namespace wr::emulator
