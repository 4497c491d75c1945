#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "units/SetPoints.hpp"
#include "units/quantities.hpp"

namespace wr {

/// @brief Measured values of one wheel. An empty optional means that the value is missing or stale.
/// @datatype
struct WheelMeasurements {
  std::optional<Velocity> velocity;   ///< velocity at the motor shaft
  std::optional<Current> current;     ///< current of the motor
  std::optional<HallCount> position;  ///< position of the wheel
  bool cutOff = false;              ///< the overcurrent trip has removed the voltage from the wheel
  bool blind = false;               ///< the wheel has voltage, but its Hall sensors show no motion
  bool reversalLate = false;        ///< the wheel could not change its orientation in time
  std::uint32_t rejectedEdges = 0;  ///< number of implausible Hall edges since start, modulo 2^32

  /// @brief Clears each value separately, because the assignment of a new object would take more
  /// time.
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
  Fault = 3     ///< the steering cannot be controlled; its motor is off
};

/// @brief Reason why the robot does not follow its set-points.
/// @datatype
enum class Inhibit : std::uint8_t {
  None = 0,           ///< the robot follows its set-points
  NoOrder = 1,        ///< no order was read since the start, or the state is Reconnecting
  Stop = 2,           ///< a source has ordered a stop
  NotArmed = 3,       ///< the source has not yet sent neutral set-points for long enough
  ProtectiveStop = 4  ///< a protective stop is latched
};

/// @brief Cause of a protective stop.
/// @datatype
enum class StopCause : std::uint8_t {
  None = 0,                ///< no protective stop
  EmergencyStop = 1,       ///< the contact of the emergency-stop circuit is open
  SteeringFault = 2,       ///< the steering device is in its fault state
  Overcurrent = 3,         ///< an overcurrent trip acted, or a current was too high for too long
  NoMotion = 4,            ///< a wheel has voltage but no motion, or is far behind other wheels
  WrongDirection = 5,      ///< a motor turns its wheel in the direction opposite to its voltage
  Overspeed = 6,           ///< a wheel is faster than allowed
  Tracking = 7,            ///< velocity and current of a wheel do not match its voltage
  MissingMeasurement = 8,  ///< a value is missing or constant for too long, or stored data are
                           ///< damaged
  HallSignals = 9,         ///< too many Hall edges of a wheel are implausible
  Reversal = 10,           ///< a wheel could not change its orientation in time
  ClockLost = 11           ///< the clock failed or did not start
};

/// @brief State of the safety functions in one control cycle.
/// @datatype
struct Protection {
  /// @brief Wheel number that is used when the cause does not concern one particular wheel.
  static constexpr std::uint8_t kNoWheel = 255;

  Inhibit inhibit = Inhibit::None;    ///< reason why the robot does not follow its set-points
  StopCause cause = StopCause::None;  ///< cause of the latched protective stop
  std::uint8_t wheel = kNoWheel;      ///< wheel that caused the stop: 0 to 3, or kNoWheel
  bool armed = false;                 ///< true when orders of the present source may move the robot

  /// @brief Returns whether two states of the safety functions are equal.
  friend constexpr bool operator==(const Protection&, const Protection&) = default;
};

/// @brief Measured values of one control cycle. An empty optional means that the value is missing
/// or stale.
/// @datatype
struct Measurements {
  std::array<WheelMeasurements, kWheelCount> wheels{};  ///< measurements of each wheel
  std::optional<Angle> steering;                        ///< position of the steering device
  SteeringState steeringState = SteeringState::Off;     ///< state of the steering
  bool leftEnd = false;                                 ///< true when the left end stop is reached
  bool rightEnd = false;                                ///< true when the right end stop is reached
  Protection protection{};                              ///< state of the safety functions

  /// @brief Clears each value.
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

/// @brief Output values of one control cycle. An empty optional means that the output was not set.
/// @datatype
struct Outputs {
  std::array<std::optional<Tension>, kWheelCount> tensions{};  ///< voltage of each wheel
  std::optional<std::int8_t> turn;  ///< direction of the steering motion: -1 right, 0 none, 1 left

  /// @brief Clears each value.
  constexpr void clear() {
    std::ranges::for_each(tensions, &std::optional<Tension>::reset);
    turn.reset();
  }

  /// @brief Returns whether two outputs are equal.
  friend constexpr bool operator==(const Outputs&, const Outputs&) = default;
};

}  // namespace wr
