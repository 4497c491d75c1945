#pragma once

#include <compare>

namespace wr {

/// @brief A number with a unit. Quantities with different units cannot be added or compared.
/// @tparam Tag type that identifies the unit; it is used for nothing else
/// @tparam Rep type of the number
/// @datatype
template <class Tag, class Rep>
class Quantity {
 public:
  /// @brief Type of the number.
  using rep = Rep;

  /// @brief Constructs the quantity zero.
  constexpr Quantity() = default;

  /// @param count number [unit of the quantity]
  explicit constexpr Quantity(Rep count) : count_(count) {}

  /// @brief Returns the number.
  /// @return number [unit of the quantity]
  [[nodiscard]] constexpr Rep count() const { return count_; }

  /// @brief Compares two quantities with the same unit.
  friend constexpr auto operator<=>(Quantity a, Quantity b) { return a.count_ <=> b.count_; }

  /// @brief Returns whether two quantities with the same unit are equal.
  friend constexpr bool operator==(Quantity a, Quantity b) { return a.count_ == b.count_; }

  /// @brief Adds two quantities with the same unit.
  friend constexpr Quantity operator+(Quantity a, Quantity b) {
    return Quantity(static_cast<Rep>(a.count_ + b.count_));
  }

  /// @brief Subtracts two quantities with the same unit.
  friend constexpr Quantity operator-(Quantity a, Quantity b) {
    return Quantity(static_cast<Rep>(a.count_ - b.count_));
  }

  /// @brief Returns the quantity with the opposite sign.
  friend constexpr Quantity operator-(Quantity a) { return Quantity(static_cast<Rep>(-a.count_)); }

  /// @brief Multiplies a quantity by a number.
  friend constexpr Quantity operator*(Quantity a, Rep factor) {
    return Quantity(static_cast<Rep>(a.count_ * factor));
  }

  /// @brief Divides a quantity by a number, which must not be zero. The result is rounded towards
  /// zero.
  friend constexpr Quantity operator/(Quantity a, Rep divisor) {
    return Quantity(static_cast<Rep>(a.count_ / divisor));
  }

 private:
  Rep count_ = 0;
};

}  // namespace wr
