#include "sim/emulator/processor/Float.hpp"

#include <algorithm>
#include <bit>
#include <initializer_list>

namespace wr::emulator {

namespace {

__extension__ using Wide = unsigned __int128;

// Bits of FPSCR (ARMv7-M ARM, A2.5.3).
constexpr std::uint32_t kInvalid = 1U << 0;
constexpr std::uint32_t kDivideByZero = 1U << 1;
constexpr std::uint32_t kOverflow = 1U << 2;
constexpr std::uint32_t kUnderflow = 1U << 3;
constexpr std::uint32_t kInexact = 1U << 4;
constexpr std::uint32_t kDenormal = 1U << 7;
constexpr std::uint32_t kFlushToZero = 1U << 24;
constexpr std::uint32_t kDefaultNan = 1U << 25;
constexpr std::uint32_t kAlternativeHalf = 1U << 26;

constexpr std::uint32_t kNan = 0x7FC00000;
constexpr std::uint32_t kQuietBit = 0x00400000;
constexpr std::uint32_t kInfinity = 0x7F800000;

std::uint32_t signOf(bool negative) {
  return negative ? Float::kSign : 0;
}

// Shifts to the right. The lowest bit of the result is also set if a lost bit was 1.
std::uint64_t jammed(Wide value, unsigned by) {
  const Wide lost = value & ((Wide{1} << by) - 1);
  return static_cast<std::uint64_t>(value >> by) | (lost != 0 ? 1U : 0U);
}

unsigned widthOf(Wide value) {
  const auto high = static_cast<std::uint64_t>(value >> 64U);
  return static_cast<unsigned>(high != 0 ? 64 + std::bit_width(high)
                                         : std::bit_width(static_cast<std::uint64_t>(value)));
}

/// The integer part of a number and the class of its fraction. 0: zero; 1: less than a half; 2: a
/// half; 3: more than a half.
struct Split {
  std::uint64_t integer;
  unsigned rest;
};

Split split(std::uint64_t value, int by) {
  if (by <= 0) {
    return {value << -by, 0};
  }
  if (by > 64) {
    return {0, value != 0 ? 1U : 0U};
  }
  const std::uint64_t half = std::uint64_t{1} << (by - 1);
  const std::uint64_t lost = by == 64 ? value : value & (2 * half - 1);
  const unsigned rest = lost == 0 ? 0U : lost < half ? 1U : lost == half ? 2U : 3U;
  return {by == 64 ? 0 : value >> by, rest};
}

}  // namespace

Float::Number Float::unpack(std::uint32_t bits) {
  const std::uint32_t fraction = bits & 0x7FFFFFU;
  const int exponent = static_cast<int>(bits >> 23 & 0xFFU);
  const bool negative = (bits & kSign) != 0;
  if (exponent == 255) {
    const Kind kind = fraction == 0                 ? Kind::Infinite
                      : (fraction & kQuietBit) != 0 ? Kind::Quiet
                                                    : Kind::Signalling;
    return {kind, negative, 0, 0, bits};
  }
  if (exponent != 0) {
    return {Kind::Finite, negative, exponent - 150, fraction | 0x800000U, bits};
  }
  if (fraction != 0 && (fpscr_ & kFlushToZero) == 0) {
    return {Kind::Finite, negative, -149, fraction, bits};
  }
  if (fraction != 0) {
    fpscr_ |= kDenormal;
  }
  return {Kind::Zero, negative, 0, 0, bits};
}

std::uint32_t Float::invalid() {
  fpscr_ |= kInvalid;
  return kNan;
}

// Implements FPProcessNaN.
std::uint32_t Float::nan(const Number& number) {
  if (number.kind == Kind::Signalling) {
    fpscr_ |= kInvalid;
  }
  return (fpscr_ & kDefaultNan) != 0 ? kNan : number.bits | kQuietBit;
}

// Implements the part of FPRound for a result that is too large.
std::uint32_t Float::overflow(bool negative, Rounding rounding, Format format) {
  const std::uint32_t infinity = format.highest << format.fraction;
  const bool toInfinity = rounding == Rounding::Nearest ||
                          (rounding == Rounding::Up && !negative) ||
                          (rounding == Rounding::Down && negative);
  fpscr_ |= kOverflow | kInexact;
  return toInfinity ? infinity : infinity - 1;
}

// Implements FPRound for 32-bit and 16-bit numbers. The result for zero is a zero with the given
// sign.
std::uint32_t Float::round(bool negative, int exponent, std::uint64_t significand,
                           Rounding rounding, Format format) {
  const bool single = format.fraction == kSingle.fraction;
  const std::uint32_t sign = single ? signOf(negative) : signOf(negative) >> 16;
  if (significand == 0) {
    return sign;
  }
  const int leading = exponent + static_cast<int>(std::bit_width(significand)) - 1;
  const bool denormal = leading < format.least;
  if (denormal && single && (fpscr_ & kFlushToZero) != 0) {
    fpscr_ |= kUnderflow;
    return sign;
  }
  const int unit = std::max(leading, format.least) - static_cast<int>(format.fraction);
  const auto [integer, rest] = split(significand, unit - exponent);
  const bool up = rounding == Rounding::Nearest ? rest == 3 || (rest == 2 && (integer & 1U) != 0)
                  : rounding == Rounding::Up    ? rest != 0 && !negative
                  : rounding == Rounding::Down  ? rest != 0 && negative
                                                : false;
  // The integer is added to the shifted exponent field. The leading bit of the integer is not part
  // of the fraction: it adds 1 to the exponent field, also when rounding has set this bit.
  const std::uint32_t field = denormal ? 0 : static_cast<std::uint32_t>(leading - format.least);
  const std::uint32_t result =
      (field << format.fraction) + static_cast<std::uint32_t>(integer) + (up ? 1U : 0U);
  const bool alternative = !single && (fpscr_ & kAlternativeHalf) != 0;
  if (alternative && result >= (format.highest + 1) << format.fraction) {
    fpscr_ |= kInvalid;
    return sign | 0x7FFFU;
  }
  if (!alternative && result >= format.highest << format.fraction) {
    return sign | overflow(negative, rounding, format);
  }
  if (rest != 0) {
    fpscr_ |= kInexact | (denormal ? kUnderflow : 0);
  }
  return sign | result;
}

std::uint32_t Float::round(const Number& number, Rounding rounding, Format format) {
  return round(number.negative, number.exponent, number.significand, rounding, format);
}

// Returns the sum of two numbers that are zero or finite.
std::uint32_t Float::sum(const Number& a, const Number& b) {
  if (a.significand == 0 && b.significand == 0) {
    const bool negative = a.negative == b.negative ? a.negative : rounding() == Rounding::Down;
    return signOf(negative);
  }
  if (a.significand == 0 || b.significand == 0) {
    return round(a.significand == 0 ? b : a, rounding());
  }
  const Number& high = a.exponent >= b.exponent ? a : b;
  const Number& low = a.exponent >= b.exponent ? b : a;
  // If the exponents differ by more than this value, the magnitude of the smaller number does not
  // affect the result.
  constexpr int kFarthest = 75;
  const int distance = std::min(high.exponent - low.exponent, kFarthest);
  const Wide left = Wide{high.significand} << static_cast<unsigned>(distance);
  const Wide right = high.exponent - low.exponent > kFarthest ? 1 : low.significand;
  const bool same = a.negative == b.negative;
  const bool highWins = same || left >= right;
  const Wide exact = same ? left + right : highWins ? left - right : right - left;
  if (exact == 0) {
    return signOf(rounding() == Rounding::Down);
  }
  const unsigned width = widthOf(exact);
  const unsigned excess = width > 62 ? width - 62 : 0;
  return round(highWins ? high.negative : low.negative,
               high.exponent - distance + static_cast<int>(excess), jammed(exact, excess),
               rounding());
}

std::uint32_t Float::add(std::uint32_t a, std::uint32_t b) {
  const Number x = unpack(a);
  return sum(x, unpack(b), false);
}

std::uint32_t Float::subtract(std::uint32_t a, std::uint32_t b) {
  const Number x = unpack(a);
  return sum(x, unpack(b), true);
}

std::uint32_t Float::sum(const Number& x, Number y, bool subtracts) {
  for (const Kind kind : {Kind::Signalling, Kind::Quiet}) {
    for (const Number* each : std::initializer_list<const Number*>{&x, &y}) {
      if (each->kind == kind) {
        return nan(*each);
      }
    }
  }
  y.negative = y.negative != subtracts;
  if (x.kind == Kind::Infinite || y.kind == Kind::Infinite) {
    if (x.kind == y.kind && x.negative != y.negative) {
      return invalid();
    }
    return signOf(x.kind == Kind::Infinite ? x.negative : y.negative) | kInfinity;
  }
  return sum(x, y);
}

std::uint32_t Float::multiply(std::uint32_t a, std::uint32_t b) {
  const Number x = unpack(a);
  const Number y = unpack(b);
  for (const Kind kind : {Kind::Signalling, Kind::Quiet}) {
    for (const Number* each : std::initializer_list<const Number*>{&x, &y}) {
      if (each->kind == kind) {
        return nan(*each);
      }
    }
  }
  const bool negative = x.negative != y.negative;
  if (x.kind == Kind::Infinite || y.kind == Kind::Infinite) {
    return x.kind == Kind::Zero || y.kind == Kind::Zero ? invalid() : signOf(negative) | kInfinity;
  }
  return round(negative, x.exponent + y.exponent, x.significand * y.significand, rounding());
}

std::uint32_t Float::multiplyAdd(std::uint32_t sum, std::uint32_t a, std::uint32_t b) {
  const Number z = unpack(sum);
  const Number x = unpack(a);
  const Number y = unpack(b);
  const bool nothingTimesAll = (x.kind == Kind::Infinite && y.kind == Kind::Zero) ||
                               (x.kind == Kind::Zero && y.kind == Kind::Infinite);
  if (z.kind == Kind::Quiet && nothingTimesAll) {
    return invalid();
  }
  for (const Kind kind : {Kind::Signalling, Kind::Quiet}) {
    for (const Number* each : {&z, &x, &y}) {
      if (each->kind == kind) {
        return nan(*each);
      }
    }
  }
  const bool negative = x.negative != y.negative;
  const bool infinite = x.kind == Kind::Infinite || y.kind == Kind::Infinite;
  if (nothingTimesAll || (infinite && z.kind == Kind::Infinite && z.negative != negative)) {
    return invalid();
  }
  if (infinite || z.kind == Kind::Infinite) {
    return signOf(infinite ? negative : z.negative) | kInfinity;
  }
  return this->sum(
      z, {Kind::Finite, negative, x.exponent + y.exponent, x.significand * y.significand, 0});
}

std::uint32_t Float::divide(std::uint32_t a, std::uint32_t b) {
  const Number x = unpack(a);
  const Number y = unpack(b);
  for (const Kind kind : {Kind::Signalling, Kind::Quiet}) {
    for (const Number* each : std::initializer_list<const Number*>{&x, &y}) {
      if (each->kind == kind) {
        return nan(*each);
      }
    }
  }
  const std::uint32_t sign = signOf(x.negative != y.negative);
  if (x.kind == y.kind && x.kind != Kind::Finite) {
    return invalid();
  }
  if (x.kind == Kind::Infinite || y.kind == Kind::Zero) {
    if (x.kind != Kind::Infinite) {
      fpscr_ |= kDivideByZero;
    }
    return sign | kInfinity;
  }
  if (x.kind == Kind::Zero || y.kind == Kind::Infinite) {
    return sign;
  }
  // The dividend is shifted to 64 bits, so that the quotient has enough bits.
  const int shift = std::countl_zero(x.significand);
  const std::uint64_t dividend = x.significand << shift;
  const std::uint64_t quotient = dividend / y.significand;
  const bool exact = quotient * y.significand == dividend;
  return round(sign != 0, x.exponent - shift - y.exponent, quotient | (exact ? 0U : 1U),
               rounding());
}

std::uint32_t Float::squareRoot(std::uint32_t a) {
  const Number x = unpack(a);
  if (x.isNan()) {
    return nan(x);
  }
  if (x.kind == Kind::Zero) {
    return signOf(x.negative);
  }
  if (x.negative) {
    return invalid();
  }
  if (x.kind == Kind::Infinite) {
    return x.bits;
  }
  // The exponent is made even, and the significand gets 62 or 63 bits. The root then has 31 or 32
  // bits.
  int shift = std::countl_zero(x.significand) - 1;
  if ((x.exponent - shift) % 2 != 0) {
    --shift;
  }
  std::uint64_t rest = x.significand << shift;
  std::uint64_t root = 0;
  for (std::uint64_t bit = std::uint64_t{1} << 62; bit != 0; bit >>= 2) {
    if (rest >= root + bit) {
      rest -= root + bit;
      root = (root >> 1) + bit;
    } else {
      root >>= 1;
    }
  }
  // The root gets an additional low bit, which is 1 if there is a remainder.
  return round(false, (x.exponent - shift) / 2 - 1, root << 1 | (rest != 0 ? 1U : 0U), rounding());
}

void Float::compare(std::uint32_t a, std::uint32_t b, bool quietIsInvalid) {
  constexpr std::uint32_t kLess = 8U << 28;
  constexpr std::uint32_t kEqual = 6U << 28;
  constexpr std::uint32_t kGreater = 2U << 28;
  constexpr std::uint32_t kUnordered = 3U << 28;
  const Number x = unpack(a);
  const Number y = unpack(b);
  std::uint32_t flags = kUnordered;
  if (x.isNan() || y.isNan()) {
    if (quietIsInvalid || x.kind == Kind::Signalling || y.kind == Kind::Signalling) {
      fpscr_ |= kInvalid;
    }
  } else {
    // The bits of a number without its sign bit are an integer. These integers have the same order
    // as the magnitudes of the numbers.
    const auto order = [](const Number& number) {
      const std::int64_t magnitude = number.kind == Kind::Zero ? 0 : number.bits & ~kSign;
      return number.negative ? -magnitude : magnitude;
    };
    const std::int64_t difference = order(x) - order(y);
    flags = difference < 0 ? kLess : difference == 0 ? kEqual : kGreater;
  }
  fpscr_ = (fpscr_ & 0x0FFFFFFFU) | flags;
}

// Implements FPToFixed.
std::uint32_t Float::toFixed(std::uint32_t a, Fixed format, bool towardsZero) {
  const Number x = unpack(a);
  if (x.isNan()) {
    fpscr_ |= kInvalid;
    return 0;
  }
  const std::int64_t most =
      (std::int64_t{1} << (format.isSigned ? format.bits - 1 : format.bits)) - 1;
  const std::int64_t least = format.isSigned ? -most - 1 : 0;
  const int by = -(x.exponent + static_cast<int>(format.fraction));
  const bool huge = x.kind == Kind::Infinite || by < -32;
  if (huge && x.kind != Kind::Zero) {
    fpscr_ |= kInvalid;
    return static_cast<std::uint32_t>(x.negative ? least : most);
  }
  const auto [integer, rest] = split(x.significand, by);
  const Rounding mode = towardsZero ? Rounding::Zero : rounding();
  const bool up = mode == Rounding::Nearest ? rest == 3 || (rest == 2 && (integer & 1U) != 0)
                  : mode == Rounding::Up    ? rest != 0 && !x.negative
                  : mode == Rounding::Down  ? rest != 0 && x.negative
                                            : false;
  const auto magnitude = static_cast<std::int64_t>(integer + (up ? 1U : 0U));
  const std::int64_t value = x.negative ? -magnitude : magnitude;
  const std::int64_t held = std::clamp(value, least, most);
  if (held != value) {
    fpscr_ |= kInvalid;
  } else if (rest != 0) {
    fpscr_ |= kInexact;
  }
  return static_cast<std::uint32_t>(held);
}

// Implements FixedToFP.
std::uint32_t Float::fromFixed(std::uint32_t a, Fixed format, bool toNearest) {
  std::int64_t value = 0;
  if (format.bits == 16) {
    value = format.isSigned ? std::int64_t{static_cast<std::int16_t>(a)} : a & 0xFFFFU;
  } else {
    value = format.isSigned ? std::int64_t{static_cast<std::int32_t>(a)} : a;
  }
  const auto magnitude = static_cast<std::uint64_t>(value < 0 ? -value : value);
  return round(value < 0, -static_cast<int>(format.fraction), magnitude,
               toNearest ? Rounding::Nearest : rounding());
}

std::uint32_t Float::fromHalf(std::uint32_t half) {
  const std::uint32_t sign = (half & 0x8000U) << 16;
  const std::uint32_t fraction = half & 0x3FFU;
  const int exponent = static_cast<int>(half >> 10 & 0x1FU);
  if (exponent == 31 && (fpscr_ & kAlternativeHalf) == 0) {
    if (fraction == 0) {
      return sign | kInfinity;
    }
    const bool signalling = (fraction & 0x200U) == 0;
    return nan({signalling ? Kind::Signalling : Kind::Quiet, sign != 0, 0, 0,
                sign | kInfinity | fraction << 13});
  }
  const std::uint64_t significand = exponent == 0 ? fraction : fraction | 0x400U;
  return round(sign != 0, std::max(exponent, 1) - 25, significand, Rounding::Nearest);
}

std::uint32_t Float::toHalf(std::uint32_t a) {
  const Number x = unpack(a);
  const std::uint32_t sign = signOf(x.negative) >> 16;
  const bool alternative = (fpscr_ & kAlternativeHalf) != 0;
  if (x.isNan()) {
    if (x.kind == Kind::Signalling || alternative) {
      fpscr_ |= kInvalid;
    }
    if (alternative) {
      return sign;
    }
    return (fpscr_ & kDefaultNan) != 0 ? 0x7E00U : sign | 0x7E00U | (x.bits >> 13 & 0x1FFU);
  }
  if (x.kind == Kind::Infinite) {
    if (alternative) {
      fpscr_ |= kInvalid;
      return sign | 0x7FFFU;
    }
    return sign | 0x7C00U;
  }
  return round(x, rounding(), kHalf);
}

}  // namespace wr::emulator
