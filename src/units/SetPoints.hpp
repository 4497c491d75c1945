#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "units/quantities.hpp"

namespace wr {

/// @brief Number of wheels: 0 front left, 1 front right, 2 rear left, 3 rear right.
inline constexpr std::size_t kWheelCount = 4;

/// @brief Quantity of a set-point of a wheel.
/// @datatype
enum class WheelQuantity : std::uint8_t {
  Velocity = 0,  ///< value in 0.1 rpm at the motor shaft
  Tension = 1,   ///< value in mV
  Current = 2    ///< value in mA
};

/// @brief Set-point of one wheel.
/// @datatype
struct WheelSetPoint {
  WheelQuantity quantity = WheelQuantity::Velocity;  ///< quantity of the value
  std::int16_t value = 0;                            ///< value in the unit of the quantity

  /// @brief Returns a set-point of a velocity.
  /// @param value velocity [0.1 rpm], -32768 to 32767
  [[nodiscard]] static constexpr WheelSetPoint velocity(Velocity value) {
    return {WheelQuantity::Velocity, static_cast<std::int16_t>(value.count())};
  }

  /// @brief Returns a set-point of a voltage.
  /// @param value voltage [mV], -32768 to 32767
  [[nodiscard]] static constexpr WheelSetPoint tension(Tension value) {
    return {WheelQuantity::Tension, static_cast<std::int16_t>(value.count())};
  }

  /// @brief Returns a set-point of a current.
  /// @param value current [mA], -32768 to 32767
  [[nodiscard]] static constexpr WheelSetPoint current(Current value) {
    return {WheelQuantity::Current, static_cast<std::int16_t>(value.count())};
  }

  /// @brief Returns the value of a set-point of a velocity.
  /// @pre The quantity is Velocity.
  [[nodiscard]] constexpr Velocity velocity() const { return Velocity(value); }

  /// @brief Returns the value of a set-point of a voltage.
  /// @pre The quantity is ``Tension``.
  [[nodiscard]] constexpr Tension tension() const { return Tension(value); }

  /// @brief Returns the value of a set-point of a current.
  /// @pre The quantity is Current.
  [[nodiscard]] constexpr Current current() const { return Current(value); }

  /// @brief Returns whether two set-points are equal.
  friend constexpr bool operator==(const WheelSetPoint&, const WheelSetPoint&) = default;
};

/// @brief Set-points of one order.
/// @datatype
struct SetPoints {
  std::uint16_t orderId = 0;                        ///< number of the order from its sender
  Angle steering{};                                 ///< angle of the steering device
  std::array<WheelSetPoint, kWheelCount> wheels{};  ///< one set-point for each wheel
  bool acknowledge = false;  ///< releases latched faults, if neutral; such an order moves nothing
  bool repeated = false;     ///< read in an earlier cycle, and still in force
  std::uint32_t sentAt = 0;  ///< time of the sender's clock when the order was sent [ms]

  /// @brief Checks whether the value of each wheel is 0, for any quantity.
  /// @return true when no wheel shall move
  [[nodiscard]] constexpr bool neutral() const {
    return std::ranges::all_of(wheels, [](const WheelSetPoint& wheel) { return wheel.value == 0; });
  }

  /// @brief Returns whether two orders are equal.
  friend constexpr bool operator==(const SetPoints&, const SetPoints&) = default;
};

}  // namespace wr
