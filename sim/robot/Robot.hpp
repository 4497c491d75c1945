#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/robot/DriveTrain.hpp"
#include "sim/robot/HallSensors.hpp"
#include "sim/robot/Noise.hpp"
#include "sim/robot/SteeringGear.hpp"

namespace wr::sim {

/// @brief Number of wheels.
inline constexpr std::size_t kWheels = 4;

/// @brief A change of the level of a Hall sensor.
struct HallEdge {
  std::chrono::nanoseconds offset;  ///< since the begin of the step, more than 0 and at most 1 ms
  std::size_t wheel;                ///< 0 to 3
  std::size_t sensor;               ///< 0 for a, 1 for b
  bool level;                       ///< from now on
};

/// @brief The ground on which the robot drives.
struct Surroundings {
  double slope = 0;                 ///< percent, positive uphill
  double rollingResistance = 0.04;  ///< share of the weight, while the robot rolls
  double staticResistance = 0.05;   ///< share of the weight, while it stands
  double grip = 0.6;                ///< greatest share of a wheel's load that its tyre can pull
};

/// @brief What can break.
enum class Fault : std::uint8_t {
  Hall,     ///< both Hall sensors of a wheel keep their levels
  HallB,    ///< sensor b of a wheel keeps its level
  Current,  ///< the cable of a current sensor is broken
  Angle,    ///< the cable of the angle sensor is broken
  Stall,    ///< the motor of the steering stalls
  Block     ///< a wheel cannot turn
};

/// @brief The physics of the robot: what its sensors give for what its actuators get.
///
/// Time is cut in steps of 1 ms. A step takes the inputs as they are and tells the edges that come
/// before the next one. Noise is a number for each step, so that each binding of the firmware sees
/// the same.
class Robot {
 public:
  static constexpr double kMass = 175.0;       ///< kg
  static constexpr double kGravity = 9.81;     ///< m/s^2
  static constexpr double kReference = 3.3;    ///< V: full scale of the converters
  static constexpr double kMiddle = 1.65;      ///< V: no current; steering straight on
  static constexpr double kPerAmpere = 0.1;    ///< V/A of the current sensors
  static constexpr double kAngleRange = 80.0;  ///< degrees over the whole scale
  static constexpr std::chrono::milliseconds kStep{1};

  /// @brief Puts the robot on the ground, at rest.
  /// @param seed chooses the noise and how far the Hall sensors are misplaced
  /// @param surroundings the ground
  explicit Robot(std::uint32_t seed, Surroundings surroundings = {});

  /// @brief Chooses other noise, and other places of the Hall sensors.
  /// @param seed chooses them
  void setSeed(std::uint32_t seed);

  /// @brief Switches the noise and the misplacement of the sensors on or off. It is on at first.
  /// @param on true for on
  void setNoise(bool on);

  /// @brief Sets the slope of the ground.
  /// @param percent positive uphill
  void setSlope(double percent) { surroundings_.slope = percent; }

  /// @brief Breaks something, or mends it.
  /// @param fault what
  /// @param wheel which wheel, where the fault is one of a wheel
  /// @param present true to break it
  void setFault(Fault fault, std::size_t wheel, bool present);

  /// @brief Sets what the driver of a wheel does.
  /// @param wheel 0 to 3
  /// @param drive duty, orientation, enable
  void setWheel(std::size_t wheel, const WheelDrive& drive) { trains_.at(wheel).set(drive); }

  /// @brief Switches the motor of the steering.
  /// @param enabled true for on
  void setSteeringEnabled(bool enabled) { steering_.enable(enabled); }

  /// @brief A step pulse of the steering.
  /// @param left direction
  void steeringStep(bool left) { steering_.step(left); }

  /// @brief Samples the sensors, then lets 1 ms pass with the present inputs.
  /// @return the edges in this time, in their order; valid until the next step
  std::span<const HallEdge> step();

  /// @brief Voltage of a current sensor at the begin of the last step.
  /// @param wheel 0 to 3
  /// @return V, 0 to 3.3
  [[nodiscard]] double currentVolts(std::size_t wheel) const { return currentVolts_.at(wheel); }

  /// @brief Voltage of the angle sensor.
  /// @return V, 0 to 3.3
  [[nodiscard]] double steeringVolts() const;

  /// @brief Level of a Hall sensor at the end of the last step.
  [[nodiscard]] bool hallLevel(std::size_t wheel, std::size_t sensor) const {
    return halls_.at(wheel).level(sensor);
  }

  /// @brief Whether the left end stop of the steering is reached.
  [[nodiscard]] bool leftEnd() const { return steering_.leftEnd(); }

  /// @brief Whether the right end stop of the steering is reached.
  [[nodiscard]] bool rightEnd() const { return steering_.rightEnd(); }

  /// @brief True velocity of a wheel's motor shaft.
  /// @return rpm, positive forwards
  [[nodiscard]] double velocityRpm(std::size_t wheel) const;

  /// @brief True position of a wheel's motor shaft.
  /// @return turns since start, positive forwards
  [[nodiscard]] double turns(std::size_t wheel) const { return trains_.at(wheel).turns(); }

  /// @brief True current of a wheel's motor.
  /// @return A, positive forwards
  [[nodiscard]] double currentAmperes(std::size_t wheel) const {
    return trains_.at(wheel).current();
  }

  /// @brief Speed over ground.
  /// @return m/s, positive forwards
  [[nodiscard]] double groundSpeed() const { return speed_; }

  /// @brief Way since start.
  /// @return m, positive forwards
  [[nodiscard]] double distance() const { return distance_; }

  /// @brief Where the steering stands.
  /// @return degrees, positive to the left
  [[nodiscard]] double steeringDegrees() const { return steering_.degrees(); }

  /// @brief Slope of the ground.
  /// @return percent, positive uphill
  [[nodiscard]] double slope() const { return surroundings_.slope; }

 private:
  void sample();
  void placeSensors();
  void advance(double seconds);
  void findEdges(std::size_t wheel, double from, int part);

  Noise noise_;
  bool noisy_ = true;
  Surroundings surroundings_;
  std::array<DriveTrain, kWheels> trains_{};
  std::array<HallSensors, kWheels> halls_{};
  SteeringGear steering_;
  std::array<std::array<bool, 2>, kWheels> hallDead_{};
  std::array<bool, kWheels> currentBroken_{};
  bool angleBroken_ = false;
  std::array<double, kWheels> currentVolts_{};
  double angleNoise_ = 0;
  double speed_ = 0;
  double distance_ = 0;
  std::uint64_t steps_ = 0;
  std::vector<HallEdge> edges_;
};

}  // namespace wr::sim
