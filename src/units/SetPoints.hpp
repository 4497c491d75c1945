#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "units/quantities.hpp"

namespace wr {

/// @brief Number of wheels. Wheel 0 is front left, 1 is front right, 2 is rear left, 3 is rear
/// right.
inline constexpr std::size_t kWheelCount = 4;

/// @brief Physical quantity of the set-point of a wheel: velocity, voltage or current.
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

  /// @brief Returns a set-point that is a velocity.
  /// @param value velocity [0.1 rpm], -32768 to 32767
  [[nodiscard]] static constexpr WheelSetPoint velocity(Velocity value) {
    return {WheelQuantity::Velocity, static_cast<std::int16_t>(value.count())};
  }

  /// @brief Returns a set-point that is a voltage.
  /// @param value voltage [mV], -32768 to 32767
  [[nodiscard]] static constexpr WheelSetPoint tension(Tension value) {
    return {WheelQuantity::Tension, static_cast<std::int16_t>(value.count())};
  }

  /// @brief Returns a set-point that is a current.
  /// @param value current [mA], -32768 to 32767
  [[nodiscard]] static constexpr WheelSetPoint current(Current value) {
    return {WheelQuantity::Current, static_cast<std::int16_t>(value.count())};
  }

  /// @brief Returns the value of this set-point as a velocity.
  /// @pre The quantity is Velocity.
  [[nodiscard]] constexpr Velocity velocity() const { return Velocity(value); }

  /// @brief Returns the value of this set-point as a voltage.
  /// @pre The quantity is ``Tension``.
  [[nodiscard]] constexpr Tension tension() const { return Tension(value); }

  /// @brief Returns the value of this set-point as a current.
  /// @pre The quantity is Current.
  [[nodiscard]] constexpr Current current() const { return Current(value); }

  /// @brief Returns whether two set-points are equal.
  friend constexpr bool operator==(const WheelSetPoint&, const WheelSetPoint&) = default;
};

/// @brief Set-points of one order.
/// @datatype
struct SetPoints {
  std::uint16_t orderId = 0;  ///< number that the sender has assigned to the order
  Angle steering{};           ///< angle of the steering device
  std::array<WheelSetPoint, kWheelCount> wheels{};  ///< one set-point for each wheel
  bool acknowledge = false;  ///< true: the order moves nothing; if the order is neutral, it
                             ///< releases latched faults
  bool repeated = false;     ///< true: the order was read in an earlier cycle and is still in force
  std::uint32_t sentAt = 0;  ///< time of the sender's clock when the order was sent [ms]

  /// @brief Checks whether the order is neutral, that is, whether the set-point of each wheel is 0.
  /// The quantities of the set-points do not matter.
  /// @return true when no wheel shall move
  [[nodiscard]] constexpr bool neutral() const {
    return std::ranges::all_of(wheels, [](const WheelSetPoint& wheel) { return wheel.value == 0; });
  }

  /// @brief Returns whether two orders are equal.
  friend constexpr bool operator==(const SetPoints&, const SetPoints&) = default;
};

}  // namespace wr
