#pragma once

#include <cstdint>

#include "units/Measurements.hpp"
#include "units/SetPoints.hpp"

namespace wr {

/// @brief A sub-system that measures, controls and actuates one part of the robot.
///
/// @function Defines the sequence of orders that every control system gets in each cycle. Each
/// subclass carries out these orders in its own way.
///
/// @secret The sequence of orders in one control cycle of a control system.
///
/// @role{control-system-orders, Abstract Class}
///
/// @patternapp{control-system-orders, Template Method, Main controller orders for control sub-systems}
/// @why The main controller sends the same sequence of orders to all control systems. Each control
/// system carries out an order in a different way.
/// @changes One system may carry out an order in a different way. A new order is one more step of
/// the sequence.
class ControlSystem {
 public:
  ControlSystem(const ControlSystem&) = delete;
  ControlSystem& operator=(const ControlSystem&) = delete;

  /// @brief Orders the system to measure, to follow the set-points and to start its work.
  /// @param setPoints set-points of all control systems; the system uses its own set-point
  /// @param cycle number of the control cycle; the first cycle has the number 1
  /// @isr{no}
  void control(const SetPoints& setPoints, std::uint32_t cycle);

  /// @brief Orders the system to measure, to stand still and to start its work.
  /// @param cycle number of the control cycle; the first cycle has the number 1
  /// @isr{no}
  void hold(std::uint32_t cycle);

  /// @brief Orders the system to measure, to release latched faults, to stand still and to start
  /// its work.
  /// @param cycle number of the control cycle; the first cycle has the number 1
  /// @isr{no}
  void acknowledge(std::uint32_t cycle);

  /// @brief Checks whether the system has completed the work that was ordered in a cycle.
  /// @param cycle number of the control cycle; the first cycle has the number 1
  /// @return true if the last completed work is the work of this cycle.
  /// @isr{no}
  [[nodiscard]] virtual bool completed(std::uint32_t cycle) const = 0;

  /// @brief Writes the measured and applied values of the system.
  /// @param measurements receives the measured values; values of other systems do not change
  /// @param outputs receives the applied values; values of other systems do not change
  /// @isr{no}
  virtual void collect(Measurements& measurements, Outputs& outputs) const = 0;

 protected:
  ControlSystem() = default;
  ~ControlSystem() = default;

 private:
  virtual void measure() = 0;
  virtual void apply(const SetPoints& setPoints) = 0;
  virtual void halt() = 0;
  virtual void release() = 0;
  virtual void activate(std::uint32_t cycle) = 0;
};

}  // namespace wr
