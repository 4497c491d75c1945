#pragma once

#include <cstdint>

namespace wr::emulator {

/// @brief Arithmetic on numbers of 32 bits as in the FPv4-SP extension, bit by bit: ARMv7-M ARM,
/// A2.5. The results do not depend on the computer that runs the simulator.
///
/// It reads the modes of FPSCR and adds to its cumulative flags.
class Float {
 public:
  /// @brief The sign of a number.
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

  /// @brief Compares two numbers, and sets N, Z, C and V of FPSCR.
  /// @param quietIsInvalid whether each NaN is an invalid operand
  void compare(std::uint32_t a, std::uint32_t b, bool quietIsInvalid);

  /// @brief An integer or a fixed-point number.
  struct Fixed {
    unsigned bits;      ///< 16 or 32
    unsigned fraction;  ///< fraction bits
    bool isSigned;
  };

  /// @brief Converts to an integer, limited to its range.
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
