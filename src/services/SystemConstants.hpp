#pragma once

#include <cstdint>

#include "units/quantities.hpp"

namespace wr {

/// @brief The constants that several modules need.
/// @function Defines each constant of the system once, with its unit.
/// @secret The value of each constant, and the source of this value.
/// @role{constant-values, Singleton}
///
/// @patternapp{constant-values, Singleton, Constant values}
/// @why Some values are needed by more than one module. All modules read these values from one
/// instance. Thus two modules cannot use different values for the same constant.
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

  /// @brief Returns N. After N failed reads in a row, the last waiting state begins.
  /// @return number of cycles [2 to 255]
  /// @satisfies FR-16
  /// @isr{yes}
  [[nodiscard]] constexpr std::uint8_t waitingCycles() const { return 4; }

  /// @brief Returns the time for which an order can be read after it was received.
  /// @return greatest age of an order [us]
  /// @satisfies FR-20
  /// @satisfies FR-50
  /// @isr{yes}
  [[nodiscard]] constexpr Microseconds orderLifetime() const { return milliseconds(200); }

  /// @brief Returns the time for which the system waits for the frame Confirm after it has sent the
  /// frame Welcome.
  /// @return greatest duration of a handshake [us]
  /// @satisfies FR-32
  /// @isr{yes}
  [[nodiscard]] constexpr Microseconds handshakeTimeout() const { return milliseconds(1000); }

  /// @brief Returns the time for which a connected PC may send nothing.
  /// @return greatest time without an accepted frame [us]
  /// @satisfies FR-33
  /// @isr{yes}
  [[nodiscard]] constexpr Microseconds linkTimeout() const { return milliseconds(1000); }

  /// @brief Returns the longest permitted time without a completed control cycle. This time is
  /// three cycle periods. Thus a cycle that is late, but completed within this time, causes no
  /// reset. If a cycle never ends, the reset occurs before the robot has moved 0.3 m.
  /// @return time-out of the watchdog [us]
  /// @satisfies FR-70
  /// @isr{yes}
  [[nodiscard]] constexpr Microseconds watchdogTimeout() const { return milliseconds(300); }

  /// @brief Returns the time from a tick to the next tick.
  /// @return period of the ticks [us]
  /// @satisfies FR-100
  /// @isr{yes}
  [[nodiscard]] constexpr Microseconds tickPeriod() const { return milliseconds(1); }

  /// @brief Returns the time for which a measured value can be used. This time lies between one and
  /// two cycle periods: a value from the previous cycle is still used, and an older value counts as
  /// missing.
  /// @return greatest age of a measurement [us]
  /// @satisfies FR-127
  /// @isr{yes}
  [[nodiscard]] constexpr Microseconds measurementLifetime() const { return milliseconds(150); }

  /// @brief Returns the voltage of the battery. A wheel motor has this voltage at a duty cycle of
  /// 100 %. Assumption: two lead batteries of 12 V.
  /// @return voltage [mV]
  /// @satisfies FR-80
  /// @isr{yes}
  [[nodiscard]] constexpr Tension supply() const { return Tension(24000); }

  /// @brief Returns the voltage that a wheel motor induces when it turns at 100.0 rpm. Assumption:
  /// 0.50 V s/rad.
  /// @return induced voltage at 100.0 rpm [mV]
  /// @satisfies FR-82
  /// @satisfies FR-85
  /// @isr{yes}
  [[nodiscard]] constexpr Tension motorConstant() const { return Tension(5236); }

  /// @brief Returns the resistance of a wheel motor, that is, of its winding and its leads
  /// together. Assumption: the current through a blocked motor at 24 V is 16 A.
  /// @return resistance [mOhm]
  /// @satisfies FR-85
  /// @satisfies FR-224
  /// @isr{yes}
  [[nodiscard]] constexpr std::int32_t winding() const { return 1500; }

  /// @brief Returns the velocity below which a wheel counts as slow. At this velocity the motor
  /// induces 2.1 V. In a short-circuited motor this voltage causes a current of 1.4 A. Without a
  /// load on the robot, a wheel with a short-circuited motor stays slow on slopes of up to 10 %.
  /// @return velocity at the motor shaft [0.1 rpm]
  /// @satisfies FR-87
  /// @satisfies FR-89
  /// @isr{yes}
  [[nodiscard]] constexpr Velocity slow() const { return Velocity(400); }

  /// @brief Returns the number of edges that the two Hall sensors of a wheel generate in one turn
  /// of the motor shaft. Assumption: the motor has 15 pairs of poles, and each of the two sensors
  /// generates two edges for each pair.
  /// @return number of edges
  /// @satisfies FR-120
  /// @isr{yes}
  [[nodiscard]] constexpr std::int32_t hallEdgesPerTurn() const { return 60; }

  /// @brief Returns the angle by which one step turns the steering. Assumption: one turn of the
  /// motor has 400 half steps, and the gear ratio is 18 to 1.
  /// @return angle of a step [0.01 degree]
  /// @satisfies FR-101
  /// @isr{yes}
  [[nodiscard]] constexpr Angle steeringStep() const { return Angle(5); }

  /// @brief Returns the greatest rate of the steering motor. A step needs one tick with the pulse
  /// and one tick without it.
  /// @return greatest rate [steps/s]
  /// @satisfies FR-103
  /// @isr{yes}
  [[nodiscard]] constexpr StepRate steeringRate() const { return StepRate(500); }

  /// @brief Returns the greatest acceleration at which the steering motor loses no step. At this
  /// acceleration the rate changes by 1 step/s in each tick.
  /// @return greatest change of the rate [steps/s^2]
  /// @satisfies FR-103
  /// @isr{yes}
  [[nodiscard]] constexpr std::int32_t steeringAcceleration() const { return 1000; }

  /// @brief Returns the greatest steering angle, to the left and to the right. The smallest turning
  /// radius of the robot, 2.5 m, needs an angle of about 32 degrees.
  /// @return greatest angle [0.01 degree]
  /// @satisfies FR-46
  /// @isr{yes}
  [[nodiscard]] constexpr Angle steeringLimit() const { return Angle(3200); }

  /// @brief Returns the greatest velocity that can be ordered, forwards and backwards. Assumption:
  /// the gear between motor shaft and wheel has a ratio of 10 to 1. If the wheel radius is 0.272 m,
  /// 300 rpm at the shaft move the robot at 0.85 m/s.
  /// @return greatest velocity at the motor shaft [0.1 rpm]
  /// @satisfies FR-46
  /// @isr{yes}
  [[nodiscard]] constexpr Velocity velocityLimit() const { return Velocity(3000); }

  /// @brief Returns the greatest voltage that can be ordered, forwards and backwards. The
  /// controller of a wheel also limits the result of each algorithm to this voltage.
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
              "there must be a waiting state before the last waiting state");
static_assert(SystemConstants::instance().steeringRate().count() *
                      SystemConstants::instance().tickPeriod().count() * 2 <=
                  1000000,
              "a step must have one tick with the pulse and one tick without it");
static_assert(SystemConstants::instance().watchdogTimeout() >
                  SystemConstants::instance().cyclePeriod() * 2,
              "the watchdog must tolerate one cycle that does not complete");

}  // namespace wr
