#pragma once

#include <cstdint>

namespace wr::emulator {

/// @brief Arithmetic on 32-bit floating-point numbers (ARMv7-M ARM, A2.5). Each result has the same
/// bits as in the FPv4-SP extension. The results do not depend on the computer that runs the
/// simulator.
///
/// An operation reads the modes in FPSCR, and sets the cumulative flags in FPSCR.
class Float {
 public:
  /// @brief The sign bit of a number.
  static constexpr std::uint32_t kSign = 0x80000000;

  /// @param fpscr the register; it must outlive this object
  explicit Float(std::uint32_t& fpscr) : fpscr_(fpscr) {}

  [[nodiscard]] std::uint32_t add(std::uint32_t a, std::uint32_t b);
  [[nodiscard]] std::uint32_t subtract(std::uint32_t a, std::uint32_t b);
  [[nodiscard]] std::uint32_t multiply(std::uint32_t a, std::uint32_t b);
  /// @brief Returns the sum of a number and a product, rounded once.
  [[nodiscard]] std::uint32_t multiplyAdd(std::uint32_t sum, std::uint32_t a, std::uint32_t b);
  [[nodiscard]] std::uint32_t divide(std::uint32_t a, std::uint32_t b);
  [[nodiscard]] std::uint32_t squareRoot(std::uint32_t a);

  /// @brief Compares two numbers, and sets N, Z, C and V in FPSCR.
  /// @param quietIsInvalid true: each NaN is an invalid operand; false: only a signalling NaN is
  /// invalid
  void compare(std::uint32_t a, std::uint32_t b, bool quietIsInvalid);

  /// @brief An integer or a fixed-point number.
  struct Fixed {
    unsigned bits;      ///< 16 or 32
    unsigned fraction;  ///< fraction bits
    bool isSigned;
  };

  /// @brief Converts a number to a fixed-point number. The result is limited to the range of its
  /// format.
  [[nodiscard]] std::uint32_t toFixed(std::uint32_t a, Fixed format, bool towardsZero);
  [[nodiscard]] std::uint32_t fromFixed(std::uint32_t a, Fixed format, bool toNearest);

  [[nodiscard]] std::uint32_t fromHalf(std::uint32_t half);
  [[nodiscard]] std::uint32_t toHalf(std::uint32_t a);

 private:
  enum class Rounding : std::uint8_t { Nearest, Up, Down, Zero };
  enum class Kind : std::uint8_t { Zero, Finite, Infinite, Quiet, Signalling };

  /// The value is significand * 2^exponent.
  struct Number {
    Kind kind;
    bool negative;
    int exponent;
    std::uint64_t significand;
    std::uint32_t bits;

    [[nodiscard]] bool isNan() const { return kind >= Kind::Quiet; }
  };

  struct Format {
    int least;  ///< exponent of the smallest normal number
    unsigned fraction;
    unsigned highest;  ///< exponent field of infinity
  };
  static constexpr Format kSingle{-126, 23, 255};
  static constexpr Format kHalf{-14, 10, 31};

  [[nodiscard]] Rounding rounding() const { return static_cast<Rounding>(fpscr_ >> 22 & 3U); }
  [[nodiscard]] Number unpack(std::uint32_t bits);
  [[nodiscard]] std::uint32_t invalid();
  [[nodiscard]] std::uint32_t nan(const Number& number);
  [[nodiscard]] std::uint32_t round(bool negative, int exponent, std::uint64_t significand,
                                    Rounding rounding, Format format = kSingle);
  [[nodiscard]] std::uint32_t round(const Number& number, Rounding rounding,
                                    Format format = kSingle);
  [[nodiscard]] std::uint32_t overflow(bool negative, Rounding rounding, Format format);
  [[nodiscard]] std::uint32_t sum(const Number& x, Number y, bool subtracts);
  [[nodiscard]] std::uint32_t sum(const Number& a, const Number& b);

  std::uint32_t& fpscr_;
};

}  // namespace wr::emulator
