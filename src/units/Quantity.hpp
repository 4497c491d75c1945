#pragma once

#include <compare>

namespace wr {

/// @brief A number with a unit. Numbers of different units cannot be combined.
/// @tparam Tag names the unit
/// @tparam Rep type of the number
/// @datatype
template <class Tag, class Rep>
class Quantity {
 public:
  /// @brief Type of the number.
  using rep = Rep;

  /// @brief Constructs the quantity zero.
  constexpr Quantity() = default;

  /// @brief Constructs a quantity of a number.
  /// @param count number [unit of the quantity]
  explicit constexpr Quantity(Rep count) : count_(count) {}

  /// @brief Returns the number.
  /// @return number [unit of the quantity]
  [[nodiscard]] constexpr Rep count() const { return count_; }

  /// @brief Compares two quantities of one unit.
  friend constexpr auto operator<=>(Quantity a, Quantity b) { return a.count_ <=> b.count_; }

  /// @brief Returns whether two quantities of one unit are equal.
  friend constexpr bool operator==(Quantity a, Quantity b) { return a.count_ == b.count_; }

  /// @brief Adds two quantities of one unit.
  friend constexpr Quantity operator+(Quantity a, Quantity b) {
    return Quantity(static_cast<Rep>(a.count_ + b.count_));
  }

  /// @brief Subtracts two quantities of one unit.
  friend constexpr Quantity operator-(Quantity a, Quantity b) {
    return Quantity(static_cast<Rep>(a.count_ - b.count_));
  }

  /// @brief Changes the sign.
  friend constexpr Quantity operator-(Quantity a) { return Quantity(static_cast<Rep>(-a.count_)); }

  /// @brief Multiplies by a number.
  friend constexpr Quantity operator*(Quantity a, Rep factor) {
    return Quantity(static_cast<Rep>(a.count_ * factor));
  }

  /// @brief Divides by a number that is not zero. The result is rounded towards zero.
  friend constexpr Quantity operator/(Quantity a, Rep divisor) {
    return Quantity(static_cast<Rep>(a.count_ / divisor));
  }

 private:
  Rep count_ = 0;
};

}  // namespace wr
