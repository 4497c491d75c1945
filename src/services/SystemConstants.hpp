#pragma once

#include <cstdint>

#include "units/quantities.hpp"

namespace wr {

/// @brief The constants that more than one module needs.
/// @function Defines each constant of the system once, with its unit.
/// @secret The values of the system's constants, and their sources.
/// @role{constant-values, Singleton}
///
/// @patternapp{constant-values, Singleton, Constant values}
/// @why Some values are needed by more than one module. One instance contains them, so that no two
/// modules can work with different values.
/// @changes The value of a constant. A new constant that several modules share.
class SystemConstants {
 public:
  SystemConstants(const SystemConstants&) = delete;
  SystemConstants& operator=(const SystemConstants&) = delete;

  /// @brief Returns the only instance.
  /// @return the constants
  /// @isr{yes}
  /// @satisfies FR-178
  [[nodiscard]] static constexpr const SystemConstants& instance() { return instance_; }

  /// @brief Returns the time between two clock pulses.
  /// @return period of the control cycle [us]
  /// @satisfies FR-1
  /// @isr{yes}
  [[nodiscard]] constexpr Microseconds cyclePeriod() const { return milliseconds(100); }

  /// @brief Returns N, the number of failed reads in a row that lead to the last waiting state.
  /// @return number of cycles [2 to 255]
  /// @satisfies FR-16
  /// @isr{yes}
  [[nodiscard]] constexpr std::uint8_t waitingCycles() const { return 4; }

  /// @brief Returns the time for which an order can be read.
  /// @return greatest age of an order [us]
  /// @satisfies FR-20
  /// @satisfies FR-50
  /// @isr{yes}
  [[nodiscard]] constexpr Microseconds orderLifetime() const { return milliseconds(200); }

  /// @brief Returns the time for which the system waits for a Confirm after a Welcome.
  /// @return greatest duration of a handshake [us]
  /// @satisfies FR-32
  /// @isr{yes}
  [[nodiscard]] constexpr Microseconds handshakeTimeout() const { return milliseconds(1000); }

  /// @brief Returns the time for which a connected PC may be silent.
  /// @return greatest silence on the link [us]
  /// @satisfies FR-33
  /// @isr{yes}
  [[nodiscard]] constexpr Microseconds linkTimeout() const { return milliseconds(1000); }

  /// @brief Returns the longest time without a completed cycle. It is three cycles: a late cycle
  /// does not cause a reset, and a stuck cycle ends before the robot has moved 0.3 m.
  /// @return time-out of the watchdog [us]
  /// @satisfies FR-70
  /// @isr{yes}
  [[nodiscard]] constexpr Microseconds watchdogTimeout() const { return milliseconds(300); }

  /// @brief Returns the time between two ticks of the second timer.
  /// @return period of the second timer [us]
  /// @satisfies FR-100
  /// @isr{yes}
  [[nodiscard]] constexpr Microseconds tickPeriod() const { return milliseconds(1); }

  /// @brief Returns the time for which a measured value can be used. It is 1.5 cycles: a value of
  /// the previous cycle is still valid, an older value is missing.
  /// @return greatest age of a measurement [us]
  /// @satisfies FR-127
  /// @isr{yes}
  [[nodiscard]] constexpr Microseconds measurementLifetime() const { return milliseconds(150); }

  /// @brief Returns the voltage of the battery, which a wheel has at a duty cycle of 100 %.
  /// Assumption:
  /// two lead batteries of 12 V.
  /// @return voltage [mV]
  /// @satisfies FR-80
  /// @isr{yes}
  [[nodiscard]] constexpr Tension supply() const { return Tension(24000); }

  /// @brief Returns the voltage that a turning wheel motor induces. Assumption: 0.50 V s/rad.
  /// @return voltage at 100.0 rpm [mV]
  /// @satisfies FR-82
  /// @satisfies FR-85
  /// @isr{yes}
  [[nodiscard]] constexpr Tension motorConstant() const { return Tension(5236); }

  /// @brief Returns the resistance of the winding of a wheel motor and its leads. Assumption: 16 A through
  /// a blocked motor at 24 V.
  /// @return resistance [mOhm]
  /// @satisfies FR-85
  /// @satisfies FR-224
  /// @isr{yes}
  [[nodiscard]] constexpr std::int32_t winding() const { return 1500; }

  /// @brief Returns the velocity below which a wheel is slow. At this velocity its motor induces
  /// 2.1 V, which cause a current of 1.4 A. A short-circuited wheel is slow on slopes of up to 11
  /// %.
  /// @return velocity at the motor shaft [0.1 rpm]
  /// @satisfies FR-87
  /// @satisfies FR-89
  /// @isr{yes}
  [[nodiscard]] constexpr Velocity slow() const { return Velocity(400); }

  /// @brief Returns the number of edges of the two Hall sensors in one turn of the motor shaft of a wheel.
  /// Assumption: a motor with 15 pairs of poles, and two sensors with two edges for each pair.
  /// @return number of edges
  /// @satisfies FR-120
  /// @isr{yes}
  [[nodiscard]] constexpr std::int32_t hallEdgesPerTurn() const { return 60; }

  /// @brief Returns the angle by which one step turns the steering. Assumption: 400 half steps in a turn of the
  /// motor, and a gear ratio of 18 to 1.
  /// @return angle of a step [0.01 degree]
  /// @satisfies FR-101
  /// @isr{yes}
  [[nodiscard]] constexpr Angle steeringStep() const { return Angle(5); }

  /// @brief Returns the greatest rate of the steering motor. A step needs two ticks: one with the pulse,
  /// one without.
  /// @return greatest rate [steps/s]
  /// @satisfies FR-103
  /// @isr{yes}
  [[nodiscard]] constexpr StepRate steeringRate() const { return StepRate(500); }

  /// @brief Returns the greatest acceleration at which the steering motor loses no step.
  /// The rate changes by one step/s in each tick.
  /// @return greatest change of the rate [steps/s^2]
  /// @satisfies FR-103
  /// @isr{yes}
  [[nodiscard]] constexpr std::int32_t steeringAcceleration() const { return 1000; }

  /// @brief Returns the greatest angle of the steering, to each side. The least radius of a turn, 2.5 m,
  /// needs about 32 degrees.
  /// @return greatest angle [0.01 degree]
  /// @satisfies FR-46
  /// @isr{yes}
  [[nodiscard]] constexpr Angle steeringLimit() const { return Angle(3200); }

  /// @brief Returns the greatest velocity that can be ordered, forwards and backwards. Assumption: the
  /// gear between motor shaft and wheel has a ratio of 10 to 1. With a wheel radius of 0.272 m, 300
  /// rpm at the shaft are 0.85 m/s.
  /// @return greatest velocity at the motor shaft [0.1 rpm]
  /// @satisfies FR-46
  /// @isr{yes}
  [[nodiscard]] constexpr Velocity velocityLimit() const { return Velocity(3000); }

  /// @brief Returns the greatest voltage that can be ordered, forwards and backwards.
  /// @return greatest voltage [mV]
  /// @satisfies FR-46
  /// @isr{yes}
  [[nodiscard]] constexpr Tension tensionLimit() const { return Tension(24000); }

  /// @brief Returns the greatest current that can be ordered, forwards and backwards.
  /// @return greatest current [mA]
  /// @satisfies FR-46
  /// @isr{yes}
  [[nodiscard]] constexpr Current currentLimit() const { return Current(10000); }

 private:
  constexpr SystemConstants() = default;

  static const SystemConstants instance_;
};

inline constexpr SystemConstants SystemConstants::instance_{};

static_assert(SystemConstants::instance().waitingCycles() >= 2,
              "there is at least one waiting state before the last");
static_assert(SystemConstants::instance().steeringRate().count() *
                      SystemConstants::instance().tickPeriod().count() * 2 <=
                  1000000,
              "a step has one tick with its pulse and one without");
static_assert(SystemConstants::instance().watchdogTimeout() >
                  SystemConstants::instance().cyclePeriod() * 2,
              "one cycle that does not complete is no reason to reset");

}  // namespace wr
