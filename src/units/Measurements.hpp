#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "units/SetPoints.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Measured values of one wheel. An empty value is missing or stale.
/// @datatype
struct WheelMeasurements {
  std::optional<Velocity> velocity;   ///< velocity at the motor shaft
  std::optional<Current> current;     ///< current of the motor
  std::optional<HallCount> position;  ///< position of the wheel
  bool cutOff = false;                ///< the overcurrent trip of the wheel has acted
  bool blind = false;                 ///< the wheel has voltage, and its Hall sensors show no
                                      ///< motion
  bool reversalLate = false;          ///< the wheel could not change its orientation in time
  std::uint16_t rejectedEdges = 0;    ///< implausible Hall edges since start, at most 65535

  /// @brief Clears each value in its place, which takes less time than a new object.
  constexpr void clear() {
    velocity.reset();
    current.reset();
    position.reset();
    cutOff = false;
    blind = false;
    reversalLate = false;
    rejectedEdges = 0;
  }

  /// @brief Returns whether two measurements are equal.
  friend constexpr bool operator==(const WheelMeasurements&, const WheelMeasurements&) = default;
};

/// @brief State of the steering.
/// @datatype
enum class SteeringState : std::uint8_t {
  Off = 0,      ///< the motor of the steering is switched off
  Holding = 1,  ///< the steering keeps its position
  Turning = 2,  ///< the steering turns towards the target
  Fault = 3     ///< the steering does not move as ordered or has no position; its motor is off
};

/// @brief Reason why the robot does not follow its set-points.
/// @datatype
enum class Inhibit : std::uint8_t {
  None = 0,           ///< the robot follows them
  NoOrder = 1,        ///< no source sends orders
  Stop = 2,           ///< a source orders stop
  NotArmed = 3,       ///< the source has not yet sent neutral set-points for long enough
  ProtectiveStop = 4  ///< a protective stop is latched
};

/// @brief Cause of a protective stop.
/// @datatype
enum class StopCause : std::uint8_t {
  None = 0,                ///< no protective stop
  EmergencyStop = 1,       ///< the contact of the emergency-stop circuit is open
  SteeringFault = 2,       ///< the steering device is in its fault state
  Overcurrent = 3,         ///< the overcurrent trip of a wheel acted
  NoMotion = 4,            ///< a wheel has voltage and its Hall sensors show no motion
  WrongDirection = 5,      ///< a wheel turns against its voltage
  Overspeed = 6,           ///< a wheel is faster than allowed
  Tracking = 7,            ///< velocity and current of a wheel do not match its voltage
  MissingMeasurement = 8,  ///< a measured value is missing for too long
  HallSignals = 9,         ///< too many Hall edges of a wheel are implausible
  Reversal = 10,           ///< a wheel could not change its orientation in time
  ClockLost = 11           ///< the clock was lost, and its monitor reset the microcontroller
};

/// @brief State of the safety functions in one control cycle.
/// @datatype
struct Protection {
  /// @brief Wheel number of a cause that concerns no single wheel.
  static constexpr std::uint8_t kNoWheel = 255;

  Inhibit inhibit = Inhibit::None;    ///< reason why the set-points are not followed
  StopCause cause = StopCause::None;  ///< cause of the latched protective stop
  std::uint8_t wheel = kNoWheel;      ///< wheel that the cause concerns, 0 to 3
  bool armed = false;                 ///< orders of the present source may move the robot

  /// @brief Compares two states of the safety functions.
  friend constexpr bool operator==(const Protection&, const Protection&) = default;
};

/// @brief Measured values of one control cycle. An empty value is missing or stale.
/// @datatype
struct Measurements {
  std::array<WheelMeasurements, kWheelCount> wheels{};  ///< measurements of each wheel
  std::optional<Angle> steering;                        ///< position of the steering device
  SteeringState steeringState = SteeringState::Off;     ///< state of the steering
  bool leftEnd = false;                                 ///< the left end stop is reached
  bool rightEnd = false;                                ///< the right end stop is reached
  Protection protection{};                              ///< state of the safety functions

  /// @brief Clears each value in its place.
  constexpr void clear() {
    std::ranges::for_each(wheels, &WheelMeasurements::clear);
    steering.reset();
    steeringState = SteeringState::Off;
    leftEnd = false;
    rightEnd = false;
    protection = {};
  }

  /// @brief Returns whether two measurements are equal.
  friend constexpr bool operator==(const Measurements&, const Measurements&) = default;
};

/// @brief Applied values of one control cycle. An empty value was not applied.
/// @datatype
struct Outputs {
  std::array<std::optional<Tension>, kWheelCount> tensions{};  ///< voltage of each wheel
  std::optional<std::int8_t> turn;  ///< turn of the steering: -1 right, 0 none, 1 left

  /// @brief Clears each value in its place.
  constexpr void clear() {
    std::ranges::for_each(tensions, &std::optional<Tension>::reset);
    turn.reset();
  }

  /// @brief Returns whether two outputs are equal.
  friend constexpr bool operator==(const Outputs&, const Outputs&) = default;
};

}  // namespace wr
