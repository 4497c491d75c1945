#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "units/SetPoints.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief What was measured at one wheel. A value that is absent is missing or stale.
/// @datatype
struct WheelMeasurements {
  std::optional<Velocity> velocity;   ///< velocity at the motor shaft
  std::optional<Current> current;     ///< current of the motor
  std::optional<HallCount> position;  ///< position of the wheel
  bool cutOff = false;                ///< its driver is switched off: the current was too high
  bool blind = false;                 ///< it has tension, and its Hall sensors give no edge
  std::uint16_t rejectedEdges = 0;    ///< edges that cannot be, since start, at most 65535

  /// @brief Tells whether two measurements are the same.
  friend constexpr bool operator==(const WheelMeasurements&, const WheelMeasurements&) = default;
};

/// @brief What the steering does.
/// @datatype
enum class SteeringState : std::uint8_t {
  Off = 0,      ///< its motor is switched off
  Holding = 1,  ///< it keeps its position
  Turning = 2,  ///< it turns towards the target
  Fault = 3     ///< it does not move as ordered, or its position is missing; its motor is off
};

/// @brief What was measured in one control cycle. A value that is absent is missing or stale.
/// @datatype
struct Measurements {
  std::array<WheelMeasurements, kWheelCount> wheels{};  ///< measurements of each wheel
  std::optional<Angle> steering;                        ///< position of the steering device
  SteeringState steeringState = SteeringState::Off;     ///< what the steering does
  bool leftEnd = false;                                 ///< the left end stop is reached
  bool rightEnd = false;                                ///< the right end stop is reached

  /// @brief Tells whether two measurements are the same.
  friend constexpr bool operator==(const Measurements&, const Measurements&) = default;
};

/// @brief What was applied in one control cycle. A value that is absent was not applied.
/// @datatype
struct Outputs {
  std::array<std::optional<Tension>, kWheelCount> tensions{};  ///< tension of each wheel
  std::optional<std::int8_t> turn;  ///< turn of the steering: -1 right, 0 none, 1 left

  /// @brief Tells whether two outputs are the same.
  friend constexpr bool operator==(const Outputs&, const Outputs&) = default;
};

}  // namespace wr
