#pragma once

#include "sim/plant/Plant.hpp"

namespace wr::plant {

/// @brief The signals from the firmware to the driver of a wheel.
struct WheelDrive {
  double duty = 0;         ///< fraction of the supply voltage at the motor, 0 to 1
  bool backwards = false;  ///< orientation; true: the voltage is negative
  bool enabled = false;    ///< false: no current can flow
};

/// @brief The contact between a wheel and the ground.
struct Contact {
  double along = 0;   ///< forward speed of the hub over the ground, m/s, negative backwards
  double across = 0;  ///< sideways speed of the hub over the ground, m/s, positive to the left
  double grip = 0;    ///< greatest force between tyre and ground, N
};

/// @brief One wheel with its tyre, its gear, its motor and the driver of the motor.
///
/// A brushless motor with its driver is modelled as a motor with a commutator. In each orientation,
/// the driver works in two quadrants. The motor gets a fraction of the supply voltage. With a
/// fraction of 0, the motor is short-circuited and brakes. The gear loses the same fraction of the
/// power, whether the motor drives the wheel or the wheel drives the motor. The tyre has a force in
/// the rolling direction and a sideways force. Both forces grow with the slip, until their sum
/// reaches the limit of friction. While the wheel is at rest, the tyre is a spring.
class DriveTrain {
 public:
  static constexpr double kRatio = 10.0;       ///< turns of the motor per turn of the wheel
  static constexpr double kEfficiency = 0.85;  ///< efficiency of the gear
  static constexpr double kRadius = 0.272;     ///< radius of the wheel [m]
  static constexpr double kCoggingPeriods =
      90.0;  ///< number of cogging periods per turn of the motor
  static constexpr double kSlipStiffness = 3000.0;  ///< stiffness of the tyre [N], for a slip of 1
  static constexpr double kRelaxation = 0.1;        ///< distance in which the tyre's force builds
                                                    ///< up, m
  static constexpr double kTyreDamping = 500.0;     ///< damping of the tyre, N s/m

  DriveTrain() { configure({}); }

  /// @brief Sets the properties of the motor.
  /// @param motor parameters of the motor
  void configure(const MotorParameters& motor);

  /// @brief Sets the inputs of the driver.
  /// @param drive duty, orientation, enable
  void set(const WheelDrive& drive) { drive_ = drive; }

  /// @brief Blocks the wheel, or frees it.
  /// @param blocked true: the wheel cannot turn
  void block(bool blocked) { blocked_ = blocked; }

  /// @brief Swaps the leads of the motor, or connects them in the right order.
  /// @param swapped true: with a positive voltage, the motor turns backwards
  void swapLeads(bool swapped) { polarity_ = swapped ? -1.0 : 1.0; }

  /// @brief Advances the time.
  /// @param seconds duration; at most 0.2 ms
  /// @param contact contact between the wheel and the ground
  /// @param supply voltage of the supply, V
  void advance(double seconds, const Contact& contact, double supply);

  /// @brief Returns the force of the tyre on the robot, in the rolling direction of the wheel.
  /// @return N, positive forwards
  [[nodiscard]] double force() const { return force_; }

  /// @brief Returns the sideways force of the tyre on the robot.
  /// @return N, positive to the left
  [[nodiscard]] double sideForce() const { return sideForce_; }

  /// @brief Returns the current of the motor.
  /// @return A, positive when the current drives the robot forwards
  [[nodiscard]] double current() const { return current_; }

  /// @brief Returns the current in the driver, as the current sensor measures it.
  /// @return A, positive when the driver drives the current forwards
  [[nodiscard]] double driverCurrent() const { return polarity_ * current_; }

  /// @brief Returns the current that the driver draws from the supply.
  /// @return A, negative when the current flows back into the supply
  [[nodiscard]] double supplyCurrent() const { return share() * current_; }

  /// @brief Returns the power that the driver puts into the motor.
  /// @return W, negative when the motor feeds power back into the supply
  [[nodiscard]] double power() const { return voltage_ * current_; }

  /// @brief Returns the torque of the motor.
  /// @return N m, positive forwards
  [[nodiscard]] double torque() const { return motor_.constant * current_; }

  /// @brief Returns the speed of the motor shaft.
  /// @return rad/s
  [[nodiscard]] double speed() const { return speed_; }

  /// @brief Returns the position of the motor shaft.
  /// @return turns since start
  [[nodiscard]] double turns() const { return turns_; }

 private:
  void advanceCurrent(double seconds, double supply);
  void advanceTyre(double seconds, const Contact& contact);
  void advanceShaft(double seconds);
  [[nodiscard]] double share() const;
  [[nodiscard]] double cogging() const;
  [[nodiscard]] double acceleration(double direction, double friction) const;

  MotorParameters motor_{};
  double inertiaDriving_ = 1;  // inertia of all rotating parts, relative to the motor shaft, when
                               // the motor drives the wheel
  double inertiaDriven_ = 1;   // the same inertia when the wheel drives the motor
  WheelDrive drive_{};
  bool blocked_ = false;
  double polarity_ = 1;
  double voltage_ = 0;
  double current_ = 0;
  double speed_ = 0;
  double turns_ = 0;
  double deflection_ = 0;      // force of the tyre's spring in the rolling direction
  double sideDeflection_ = 0;  // sideways force of the tyre's spring
  double force_ = 0;
  double sideForce_ = 0;
};

}  // namespace wr::plant
