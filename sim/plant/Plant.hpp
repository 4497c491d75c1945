#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "sim/plant/Noise.hpp"

namespace wr::plant {

/// @brief Number of wheels.
inline constexpr std::size_t kWheels = 4;

/// @brief The motor of one wheel, with its driver and its cable.
///
/// Hub motors with 15 pole pairs and 24 V to 36 V have a torque constant of about 0.52 N m/A. Their
/// two Hall sensors have 60 edges in a turn. The source is ODrive, "Hoverboard motor and remote
/// control setup guide" (15 pole pairs, 8.27 / 16 N m/A). The other values are assumed. As in a
/// real motor, two values differ from the values that the firmware assumes. The resistance differs
/// by 5 %, and the torque constant differs by 4 %.
struct MotorParameters {
  double resistance = 1.42;      ///< winding, cable and driver [ohm]
  double inductance = 1.5e-3;    ///< [H]
  double constant = 0.52;        ///< [V s/rad], and the same number in N m/A
  double friction = 0.04;        ///< friction while the motor turns [N m]
  double staticFriction = 0.06;  ///< friction while the motor is at rest [N m]
  double damping = 0.5e-3;       ///< [N m s/rad]
  double cogging = 0.02;         ///< greatest torque of the magnets [N m]
  double rotorInertia = 1.5e-3;  ///< [kg m^2]
  double wheelInertia = 0.28;    ///< kg m^2, for a disc of 7.5 kg
};

/// @brief The current sensor of one wheel.
struct CurrentSensorParameters {
  double gain = 1.0;    ///< as a factor of the nominal gain, 0.1 V/A
  double offset = 0.0;  ///< A
};

/// @brief Properties of the parts of a robot. Some properties differ between robots, loads and
/// batteries. Plant.cpp contains the ranges of these properties.
struct Plant {
  std::array<MotorParameters, kWheels> motors{};
  std::array<CurrentSensorParameters, kWheels> currentSensors{};
  double mass = 175.0;              ///< mass in the robot's public description [kg]
  double yawInertia = 85.0;         ///< nearly the inertia of a box of 2.0 m by 1.4 m [kg m^2]
  double supply = 24.0;             ///< voltage of the battery without load [V]
  double batteryResistance = 0.03;  ///< resistance of two lead batteries, cable and fuse [ohm]
  double rollingResistance = 0.04;  ///< fraction of the weight, for a robot that rolls on a meadow
  double staticResistance = 0.05;   ///< fraction of the weight, for a robot at rest
  double angleGain = 1.0;           ///< as a factor of the nominal gain, 80 degrees / 3.3 V
  double angleOffset = 0.0;         ///< degrees

  /// @brief Returns a robot with random parameters. Each parameter is within its range.
  /// @param noise chooses the values
  /// @return the robot
  [[nodiscard]] static Plant varied(const Noise& noise);
};

/// @brief Parameters that a scenario can set.
enum class Parameter : std::uint8_t {
  Supply,         ///< V
  Battery,        ///< ohm
  Mass,           ///< factor of the nominal value, as for all following parameters
  Inertia,        ///< inertia of the rotors and wheels, and of the robot in yaw
  Resistance,     ///< resistance of the motors
  MotorConstant,  ///< constant of the motors
  Friction,       ///< friction of the motors
  Rolling,        ///< rolling resistance
  CurrentGain,    ///< gain of the current sensors
  AngleGain       ///< gain of the angle sensor
};

/// @brief Sets a parameter.
/// @param plant the robot
/// @param parameter parameter to set
/// @param value the value, in the unit of the parameter
void setParameter(Plant& plant, Parameter parameter, double value);

}  // namespace wr::plant
