#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "devices/Timebase.hpp"
#include "services/Pipe.hpp"
#include "units/Measurements.hpp"
#include "units/SetPoints.hpp"
#include "units/quantities.hpp"
#include "wheel_control/algorithms/WheelAlgorithm.hpp"
#include "wheel_control/behaviours/WheelBehaviour.hpp"
#include "wheel_control/commands/WheelCommand.hpp"

namespace wr {

/// @brief The controller of one wheel.
///
/// @function Reads the measured values of the wheel from their pipes. Lets the algorithm of the
/// ordered quantity calculate a voltage, and lets a behaviour apply this voltage. Stops a wheel
/// that cannot be controlled.
///
/// @secret The measured values that are used for the control, and the rule that detects a wheel
/// that cannot be controlled.
///
/// @role{wheel-control-algorithms, Context}
/// @role{wheel-behaviours, Context}
/// @role{wheel-commands, Invoker}
class WheelController final {
 public:
  /// @brief Parts of the controller. Each part must exist for as long as the controller exists.
  /// @datatype
  struct Parts {
    Pipe<Velocity>& velocity;  ///< pipe of the measured velocity
    Pipe<Current>& current;    ///< pipe of the measured current
    const Timebase& timebase;  ///< returns the time, to compute the age of a measured value
    std::array<WheelAlgorithm*, 3> algorithms;  ///< the algorithm for each value of WheelQuantity
    WheelBehaviour& advance;                    ///< applies the demand of an algorithm
    WheelBehaviour& stop;                       ///< lowers the voltage, then stops the wheel
    WheelCommand& stopWheel;                    ///< removes all voltage from the wheel at once
  };

  /// @brief Constructs the controller of a wheel at rest.
  /// @param parts parts of the controller
  explicit WheelController(const Parts& parts);

  WheelController(const WheelController&) = delete;
  WheelController& operator=(const WheelController&) = delete;

  /// @brief Controls the wheel towards its set-point for one cycle. Stops the wheel if its velocity
  /// or its current is missing, if it has no motion feedback, or if its reversal is late.
  /// @param setPoint set-point of the wheel
  /// @param measured measured values of the wheel in this cycle
  /// @satisfies FR-80
  /// @satisfies FR-86
  /// @satisfies FR-301
  /// @satisfies FR-90
  /// @satisfies FR-91
  /// @satisfies FR-222
  /// @isr{no}
  void control(const WheelSetPoint& setPoint, const WheelMeasurements& measured);

  /// @brief Executes one cycle of a stop: lowers the voltage of the wheel, and brakes the wheel if
  /// the voltage is then 0. Latched faults stay latched.
  /// @satisfies FR-88
  /// @satisfies FR-95
  /// @isr{no}
  void halt();

  /// @brief Stops a wheel whose overcurrent trip has acted: no voltage is applied. The stored
  /// values of the algorithms and the applied voltage are cleared. If this method is called twice
  /// in a control cycle, the second call does not stop the wheel again.
  /// @satisfies FR-89
  /// @satisfies FR-221
  /// @isr{no}
  void driverOff();

  /// @brief Releases the two latched faults: no motion feedback, and a late reversal.
  /// @satisfies FR-91
  /// @satisfies FR-222
  /// @isr{no}
  void release();

  /// @brief Returns the measured velocity.
  /// @param at the present time
  /// @return velocity [0.1 rpm]; nothing if no velocity was measured yet, or if the velocity is
  /// older than the lifetime of a measurement
  /// @satisfies FR-90
  /// @satisfies FR-127
  /// @isr{no}
  [[nodiscard]] std::optional<Velocity> velocity(Instant at) const;

  /// @brief Returns the measured current.
  /// @param at the present time
  /// @return current [mA]; nothing if no current was measured yet, or if the current is older than
  /// the lifetime of a measurement
  /// @satisfies FR-90
  /// @satisfies FR-127
  /// @isr{no}
  [[nodiscard]] std::optional<Current> current(Instant at) const;

  /// @brief Returns the applied voltage of the wheel.
  /// @return voltage [mV], positive forwards; nothing before the first cycle and after an
  /// overcurrent trip
  /// @satisfies FR-94
  /// @isr{no}
  [[nodiscard]] std::optional<Tension> applied() const;

  /// @brief Checks whether the wheel had voltage while its Hall sensors showed no motion.
  /// @return true from the detection of this fault until release()
  /// @satisfies FR-91
  /// @isr{no}
  [[nodiscard]] bool blind() const;

  /// @brief Checks whether the wheel could not change its orientation in time.
  /// @return true from the detection of this fault until release()
  /// @satisfies FR-222
  /// @isr{no}
  [[nodiscard]] bool reversalLate() const;

 private:
  void watchMotion(const WheelSetPoint& setPoint, const WheelMeasurements& measured);
  [[nodiscard]] std::int32_t effort(const WheelSetPoint& setPoint, Tension tension,
                                    Current current) const;
  [[nodiscard]] bool isHeld(Current current) const;
  void watchReversal(const WheelSetPoint& setPoint, Tension demand);
  void follow(const WheelSetPoint& setPoint, const WheelFeedback& feedback);
  void lower();
  void resetAlgorithms();

  Pipe<Velocity>& velocity_;
  Pipe<Current>& current_;
  const Timebase& timebase_;
  std::array<WheelAlgorithm*, 3> algorithms_;
  WheelBehaviour& advance_;
  WheelBehaviour& stop_;
  WheelCommand& stopWheel_;
  WheelQuantity quantity_ = WheelQuantity::Velocity;  // quantity of the last set-point
  std::optional<Tension> applied_;
  HallCount seen_{};                  // position at the last detected motion of the wheel
  std::int32_t effort_ = 0;           // [mV cycles] sum that watchMotion() computes
  std::optional<Instant> driverOff_;  // time at which driverOff() stopped the wheel last
  std::uint8_t waitingCycles_ = 0;    // cycles in a row in which a reversal waits without voltage
  bool blind_ = false;
  bool reversalLate_ = false;
};

}  // namespace wr
