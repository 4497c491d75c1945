#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/plant/DriveTrain.hpp"
#include "sim/plant/HallSensors.hpp"
#include "sim/plant/Noise.hpp"
#include "sim/plant/Plant.hpp"
#include "sim/plant/SteeringGear.hpp"
#include "sim/plant/SteeringLinkage.hpp"

namespace wr::plant {

/// @brief A change of the level of a Hall sensor.
struct HallEdge {
  std::chrono::nanoseconds
      offset;          ///< time since the start of the step, more than 0 and at most 1 ms
  std::size_t wheel;   ///< 0 to 3
  std::size_t sensor;  ///< 0 for a, 1 for b
  bool level;          ///< level after the change
};

/// @brief The ground on which the robot drives.
struct Ground {
  double slope = 0;  ///< percent, positive uphill in the direction in which the robot starts
  double grip =
      0.6;  ///< greatest force that a tyre can transmit, as a fraction of the wheel's load
};

/// @brief Kind of a fault.
enum class Fault : std::uint8_t {
  Hall,           ///< both Hall sensors of a wheel keep their levels
  HallA,          ///< sensor a of a wheel keeps its level
  HallB,          ///< sensor b of a wheel keeps its level
  HallSwapped,    ///< the two Hall sensors of a wheel are swapped at their pins
  HallMisplaced,  ///< sensor b of a wheel is displaced; value: electrical degrees
  HallGlitches,   ///< pulses of 30 us on sensor a of a wheel; value: pulses per second
  HallLosses,     ///< edges of a wheel are lost; value: edges per second
  Leads,          ///< the leads of a motor are swapped
  Current,        ///< the cable of a current sensor is broken; its input is pulled to 0 V
  CurrentOpen,   ///< the cable of a current sensor is broken; the voltage of its open input follows
                 ///< the input that is converted before it
  CurrentStuck,  ///< a current sensor keeps its value
  CurrentOffset,  ///< a current sensor has an offset; value: mA
  Angle,          ///< the cable of the angle sensor is broken; its input is pulled to 0 V
  AngleOpen,   ///< the cable of the angle sensor is broken; the voltage of its open input follows
               ///< the input that is converted before it
  AngleStuck,  ///< the angle sensor keeps its value
  AngleDrift,  ///< the angle sensor drifts; value: 0.01 degree per second
  Stall,       ///< the steering is stuck
  Block,       ///< a wheel cannot turn
  LeftEnd,     ///< the wire of the left end stop is broken
  RightEnd     ///< the wire of the right end stop is broken
};

/// @brief Effect of the emergency stop's circuit on the motors.
enum class EmergencyStop : std::uint8_t {
  Released,  ///< the circuit has no effect
  Coast,     ///< the circuit removes the power of all drivers; the motors have no current
  Brake      ///< the circuit removes the power, and short-circuits the motors of the wheels
};

/// @brief The physics of the robot. The inputs are the signals to the actuators, and the outputs
/// are the values of the sensors.
///
/// Time is divided into steps of 1 ms. A step uses the present inputs, and returns the edges that
/// occur during the step. Noise depends only on the seed and the step. Therefore the noise is equal
/// for all targets of the firmware.
class Robot {
 public:
  static constexpr double kGravity = 9.81;     ///< m/s^2
  static constexpr double kReference = 3.3;    ///< full scale of the converters [V]
  static constexpr double kMiddle = 1.65;      ///< voltage without current, or straight ahead [V]
  static constexpr double kPerAmpere = 0.1;    ///< nominal gain of the current sensors [V/A]
  static constexpr double kAngleRange = 80.0;  ///< nominal range of the angle sensor [degree]
  static constexpr std::chrono::milliseconds kStep{1};

  /// @brief Puts the nominal robot on the ground, at rest.
  /// @param seed chooses the noise and the displacement of the Hall sensors
  /// @param surroundings the ground
  explicit Robot(std::uint32_t seed, Ground surroundings = {});

  /// @brief Chooses new noise and new displacements of the Hall sensors. After vary(true), also
  /// chooses new properties of the robot's parts.
  /// @param seed seed of the choice
  void setSeed(std::uint32_t seed);

  /// @brief Sets the properties of the robot's parts.
  /// @param plant properties of the parts
  void setPlant(const Plant& plant);

  /// @brief Sets random or nominal properties of the robot's parts. The seed chooses the random
  /// properties.
  /// @param varied true: random properties; false: nominal properties
  void vary(bool varied);

  /// @brief Sets one parameter of the robot.
  /// @param parameter parameter to set
  /// @param value the value, in the unit of the parameter
  void setParameter(Parameter parameter, double value);

  /// @brief Switches the noise and the displacement of the sensors on or off. Both are initially
  /// on.
  /// @param on true for on
  void setNoise(bool on);

  /// @brief Sets the slope of the ground ahead. The robot reaches this slope axle by axle. Therefore
  /// the slope of the robot changes evenly over one wheelbase. If the robot drives slowly or is at
  /// rest, its slope changes within 2 s.
  /// @param percent positive uphill, in the direction in which the robot started
  void setSlope(double percent);

  /// @brief Sets the grip of the ground.
  /// @param share greatest force that a tyre can transmit, as a fraction of the wheel's load
  void setGrip(double share) { surroundings_.grip = share; }

  /// @brief Sets a fault, or repairs it.
  /// @param fault kind
  /// @param wheel number of the wheel, for faults of a wheel
  /// @param present true: the fault is present; false: it is repaired
  /// @param value value of the fault, for faults with a value
  void setFault(Fault fault, std::size_t wheel, bool present, double value = 0);

  /// @brief Presses or releases the emergency stop.
  /// @param state state of the emergency stop's circuit
  void setEmergencyStop(EmergencyStop state);

  /// @brief Sets the firmware's signals to the driver of a wheel.
  /// @param wheel 0 to 3
  /// @param drive duty, orientation, enable
  void setWheel(std::size_t wheel, const WheelDrive& drive);

  /// @brief Returns the firmware's signals to the driver of a wheel.
  /// @param wheel 0 to 3
  [[nodiscard]] const WheelDrive& drive(std::size_t wheel) const { return drives_.at(wheel); }

  /// @brief Switches the motor of the steering on or off.
  /// @param enabled true for on
  void setSteeringEnabled(bool enabled) { steering_.enable(enabled && hasPower()); }

  /// @brief Executes one step pulse of the steering.
  /// @param left true: to the left; false: to the right
  void steeringStep(bool left) { steering_.step(left); }

  /// @brief Samples the sensors. Then simulates 1 ms with the present inputs.
  /// @return the edges in this time, in the order of time; the result is valid until the next step
  std::span<const HallEdge> step();

  /// @brief Resets the greatest velocity.
  void clearGreatestVelocity() { greatestRpm_ = 0; }

  /// @brief Returns the voltage of a current sensor at the start of the last step.
  /// @param wheel 0 to 3
  /// @return V, 0 to 3.3
  [[nodiscard]] double currentVolts(std::size_t wheel) const { return currentVolts_.at(wheel); }

  /// @brief Returns the voltage of the angle sensor.
  /// @return V, 0 to 3.3
  [[nodiscard]] double steeringVolts() const;

  /// @brief Returns the level of a Hall sensor at the end of the last step.
  [[nodiscard]] bool hallLevel(std::size_t wheel, std::size_t sensor) const {
    return halls_.at(wheel).level(sensor);
  }

  /// @brief Returns true if the contact of the left end stop is open. The contact is open if the
  /// end is reached or the wire is broken.
  [[nodiscard]] bool leftEnd() const { return leftEndBroken_ || steering_.leftEnd(); }

  /// @brief Returns true if the contact of the right end stop is open. The contact is open if the
  /// end is reached or the wire is broken.
  [[nodiscard]] bool rightEnd() const { return rightEndBroken_ || steering_.rightEnd(); }

  /// @brief Returns true if the emergency stop is pressed. Its auxiliary contact is then open.
  [[nodiscard]] bool emergencyStopOpen() const { return !hasPower(); }

  /// @brief Returns the true velocity of a wheel's motor shaft.
  /// @return rpm, positive forwards
  [[nodiscard]] double velocityRpm(std::size_t wheel) const;

  /// @brief Returns the greatest true velocity of any wheel since the start, or since the last call
  /// of clearGreatestVelocity().
  /// @return magnitude of the velocity [rpm]
  [[nodiscard]] double greatestRpm() const { return greatestRpm_; }

  /// @brief Returns the true position of a wheel's motor shaft.
  /// @return turns since start, positive forwards
  [[nodiscard]] double turns(std::size_t wheel) const { return trains_.at(wheel).turns(); }

  /// @brief Returns the true current of a wheel's motor.
  /// @return A, positive when the current drives the robot forwards
  [[nodiscard]] double currentAmperes(std::size_t wheel) const {
    return trains_.at(wheel).current();
  }

  /// @brief Returns the true torque of a wheel's motor.
  /// @return N m at the shaft, positive forwards
  [[nodiscard]] double torque(std::size_t wheel) const { return trains_.at(wheel).torque(); }

  /// @brief Returns true if no driver puts power into its motor. The robot then brakes, rolls or is
  /// at rest.
  [[nodiscard]] bool braking() const;

  /// @brief Returns the speed over ground at the middle of the robot, in the direction of its axis.
  /// @return m/s, positive forwards
  [[nodiscard]] double groundSpeed() const { return speed_; }

  /// @brief Returns the sideways speed over ground at the middle of the robot.
  /// @return m/s, positive to the left
  [[nodiscard]] double sideSpeed() const { return sideSpeed_; }

  /// @brief Returns the rate at which the robot turns.
  /// @return rad/s, positive to the left
  [[nodiscard]] double yawRate() const { return yawRate_; }

  /// @brief Returns the direction in which the robot points.
  /// @return heading relative to the heading at the start [rad], positive to the left
  [[nodiscard]] double heading() const { return heading_; }

  /// @brief Returns the speed at which the tyre of a wheel slides sideways.
  /// @return m/s, positive to the left
  [[nodiscard]] double sideSlip(std::size_t wheel) const;

  /// @brief Returns the distance along the path since the start.
  /// @return m, positive forwards
  [[nodiscard]] double distance() const { return distance_; }

  /// @brief Returns the angle of the steering.
  /// @return degrees, positive to the left
  [[nodiscard]] double steeringDegrees() const { return steering_.degrees(); }

  /// @brief Returns the slope of the ground under the robot.
  /// @return percent, positive uphill in the direction in which the robot started
  [[nodiscard]] double slope() const { return surroundings_.slope; }

  /// @brief Returns the voltage of the supply under its load.
  /// @return V
  [[nodiscard]] double supplyVolts() const { return supply_; }

  /// @brief Returns the properties of the robot's parts.
  /// @return parameters of the robot
  [[nodiscard]] const Plant& plant() const { return plant_; }

 private:
  struct Forces {
    double along;
    double across;
    double turning;
  };

  struct HallFaults {
    std::array<bool, 2> dead{};
    bool swapped = false;
    double misplaced = 0;  // edges
    double glitches = 0;   // in a second
    double losses = 0;     // in a second
    bool losesNext = false;
  };

  struct CurrentFaults {
    bool broken = false;
    bool open = false;
    bool stuck = false;
    double offset = 0;  // A
  };

  [[nodiscard]] bool hasPower() const { return emergencyStop_ == EmergencyStop::Released; }
  void setHallFault(Fault fault, HallFaults& faults, bool present, double value);
  [[nodiscard]] double voltsBefore(std::size_t wheel) const;
  void setAngleFault(Fault fault, bool present, double value);
  void applyDrive(std::size_t wheel);
  void sample();
  void sampleAngle();
  [[nodiscard]] double trueAngleVolts() const;
  void placeSensors();
  void advanceSlope();
  void feelGround();
  void advance(double seconds);
  [[nodiscard]] Contact contactOf(const WheelPose& pose) const;
  void advanceAlong(double force, double seconds);
  void findEdges(std::size_t wheel, double from);
  void addGlitch(std::size_t wheel);
  void addEdge(HallEdge edge);
  [[nodiscard]] bool happens(std::uint32_t source, std::size_t wheel, double perSecond) const;

  Noise noise_;
  bool noisy_ = true;
  bool varied_ = false;
  Plant plant_{};
  Ground surroundings_;
  double slopeBefore_ = 0;   // percent; slope before the change
  double slopeAhead_ = 0;    // percent
  double slopeReached_ = 1;  // completed fraction of the change
  std::array<DriveTrain, kWheels> trains_{};
  std::array<WheelDrive, kWheels> drives_{};
  std::array<HallSensors, kWheels> halls_{};
  SteeringGear steering_;
  SteeringLinkage linkage_;
  EmergencyStop emergencyStop_ = EmergencyStop::Released;
  std::array<HallFaults, kWheels> hallFaults_{};
  std::array<CurrentFaults, kWheels> currentFaults_{};
  bool angleBroken_ = false;
  bool angleOpen_ = false;
  bool angleStuck_ = false;
  double angleDrift_ = 0;  // degrees in a step
  double angleDrifted_ = 0;
  double keptVolts_ = 0;  // voltage of an angle input that is open or stuck
  bool leftEndBroken_ = false;
  bool rightEndBroken_ = false;
  std::array<double, kWheels> currentVolts_{};
  double angleNoise_ = 0;
  Forces ground_{};  // gravity along the ground in this step
  double weight_ = 0;
  double grip_ = 0;
  double supply_ = 0;
  double speed_ = 0;
  double sideSpeed_ = 0;
  double yawRate_ = 0;
  double heading_ = 0;
  double distance_ = 0;
  double greatestRpm_ = 0;
  std::uint64_t steps_ = 0;
  std::vector<HallEdge> edges_;
};

}  // namespace wr::plant
