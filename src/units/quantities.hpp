#pragma once

#include <compare>
#include <cstdint>

#include "units/Quantity.hpp"

namespace wr {

/// @brief Speed of rotation of a motor shaft [0.1 rpm]; a positive speed drives the robot forwards.
/// @datatype
using Velocity = Quantity<struct VelocityTag, std::int32_t>;

/// @brief Voltage of a wheel motor [mV]; a positive voltage drives the robot forwards.
/// @datatype
using Tension = Quantity<struct TensionTag, std::int32_t>;

/// @brief Current of a wheel motor [mA]; a positive current drives the robot forwards.
/// @datatype
using Current = Quantity<struct CurrentTag, std::int32_t>;

/// @brief Angle of the steering device [0.01 degree]; angles to the left are positive.
/// @datatype
using Angle = Quantity<struct AngleTag, std::int32_t>;

/// @brief Share of the period in which an output is on [0.01 %], 0 to 10000.
/// @datatype
using DutyCycle = Quantity<struct DutyCycleTag, std::int32_t>;

/// @brief Speed of the steering motor [steps/s]; a turn to the left is positive.
/// @datatype
using StepRate = Quantity<struct StepRateTag, std::int32_t>;

/// @brief Position of a wheel [Hall edges since start]; it increases while the wheel turns
/// forwards.
/// @datatype
using HallCount = Quantity<struct HallCountTag, std::int32_t>;

/// @brief Returns the number of edges from one position of a wheel to another. The count of edges
/// in a position can overflow. The result is correct even then, because the number of edges between
/// the two positions is small.
/// @param from the earlier position
/// @param to the later position
/// @return number of edges; positive when the wheel has turned forwards
[[nodiscard]] constexpr HallCount edgesBetween(HallCount from, HallCount to) {
  return HallCount(static_cast<std::int32_t>(static_cast<std::uint32_t>(to.count()) -
                                             static_cast<std::uint32_t>(from.count())));
}

/// @brief Duration [us].
/// @datatype
using Microseconds = Quantity<struct MicrosecondsTag, std::int64_t>;

/// @brief Converts a number of milliseconds to a duration.
/// @param count duration [ms]
/// @return the duration
[[nodiscard]] constexpr Microseconds milliseconds(std::int64_t count) {
  return Microseconds(count * 1000);
}

/// @brief Point in time [us since start]. The number has 64 bits, and therefore does not overflow
/// in the life of a robot.
/// @datatype
class Instant {
 public:
  /// @brief Constructs the instant of the start.
  constexpr Instant() = default;

  /// @param sinceStart time since start [us]
  explicit constexpr Instant(std::uint64_t sinceStart) : sinceStart_(sinceStart) {}

  /// @brief Returns the time since start.
  /// @return time since start [us]
  [[nodiscard]] constexpr std::uint64_t sinceStart() const { return sinceStart_; }

  /// @brief Compares two instants: the later instant is greater.
  friend constexpr auto operator<=>(Instant a, Instant b) {
    return a.sinceStart_ <=> b.sinceStart_;
  }

  /// @brief Returns whether two instants are equal.
  friend constexpr bool operator==(Instant a, Instant b) { return a.sinceStart_ == b.sinceStart_; }

  /// @brief Returns the duration from the earlier instant to the later instant.
  friend constexpr Microseconds operator-(Instant later, Instant earlier) {
    return Microseconds(static_cast<std::int64_t>(later.sinceStart_ - earlier.sinceStart_));
  }

  /// @brief Returns the instant that is later than another instant by a given duration.
  friend constexpr Instant operator+(Instant instant, Microseconds duration) {
    return Instant(instant.sinceStart_ + static_cast<std::uint64_t>(duration.count()));
  }

 private:
  std::uint64_t sinceStart_ = 0;
};

}  // namespace wr
