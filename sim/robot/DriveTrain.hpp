#pragma once

namespace wr::sim {

/// @brief What the firmware puts on the driver of a wheel.
struct WheelDrive {
  double duty = 0;         ///< share of the supply that the motor sees, 0 to 1
  bool backwards = false;  ///< orientation
  bool enabled = false;    ///< false: no current can flow
};

/// @brief Motor, driver, gear, wheel and tyre of one wheel.
///
/// A brushless motor with its driver is taken for a motor with a commutator. The driver works in
/// two quadrants of each orientation: the motor sees a share of the supply, and with a share of 0
/// it is short-circuited and brakes. The gear loses the same share of the power in either
/// direction. The tyre's force grows with its slip up to the limit of friction, and while the wheel
/// stands the tyre is a spring.
class DriveTrain {
 public:
  static constexpr double kSupply = 24.0;           ///< V
  static constexpr double kResistance = 1.5;        ///< ohm
  static constexpr double kInductance = 1.5e-3;     ///< H: a lag of 1 ms
  static constexpr double kMotorConstant = 0.50;    ///< V s/rad and N m/A
  static constexpr double kRatio = 10.0;            ///< turns of the motor for one of the wheel
  static constexpr double kEfficiency = 0.85;       ///< of the gear
  static constexpr double kRadius = 0.272;          ///< of the wheel, m
  static constexpr double kRotorInertia = 1.5e-3;   ///< kg m^2
  static constexpr double kWheelInertia = 0.28;     ///< kg m^2: 7.5 kg, as a disc
  static constexpr double kFriction = 0.04;         ///< of the motor while it turns, N m
  static constexpr double kStaticFriction = 0.06;   ///< of the motor while it stands, N m
  static constexpr double kDamping = 0.5e-3;        ///< of the motor, N m s/rad
  static constexpr double kCogging = 0.02;          ///< greatest torque of the magnets, N m
  static constexpr double kCoggingPeriods = 90.0;   ///< in a turn of the motor
  static constexpr double kSlipStiffness = 3000.0;  ///< of the tyre, N for a slip of 1
  static constexpr double kRelaxation = 0.1;        ///< way in which the tyre's force builds up, m
  static constexpr double kTyreDamping = 500.0;     ///< N s/m

  /// @brief Sets what the driver does.
  /// @param drive duty, orientation, enable
  void set(const WheelDrive& drive) { drive_ = drive; }

  /// @brief Blocks the wheel, or frees it.
  /// @param blocked true: it cannot turn
  void block(bool blocked) { blocked_ = blocked; }

  /// @brief Lets time pass.
  /// @param seconds how much; at most 0.2 ms
  /// @param ground speed of the ground under the wheel, m/s
  /// @param grip greatest force between tyre and ground, N
  void advance(double seconds, double ground, double grip);

  /// @brief Force of the tyre on the robot.
  /// @return N, positive forwards
  [[nodiscard]] double force() const { return force_; }

  /// @brief Current of the motor.
  /// @return A, positive forwards
  [[nodiscard]] double current() const { return current_; }

  /// @brief Speed of the motor shaft.
  /// @return rad/s
  [[nodiscard]] double speed() const { return speed_; }

  /// @brief Position of the motor shaft.
  /// @return turns since start
  [[nodiscard]] double turns() const { return turns_; }

 private:
  void advanceCurrent(double seconds);
  void advanceTyre(double seconds, double ground, double grip);
  void advanceShaft(double seconds);
  [[nodiscard]] double cogging() const;
  [[nodiscard]] double acceleration(double direction, double friction) const;

  WheelDrive drive_{};
  bool blocked_ = false;
  double current_ = 0;
  double speed_ = 0;
  double turns_ = 0;
  double deflection_ = 0;  // force of the tyre's spring
  double force_ = 0;
};

}  // namespace wr::sim
