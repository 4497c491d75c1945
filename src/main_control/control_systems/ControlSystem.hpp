#pragma once

#include <cstdint>

#include "units/Measurements.hpp"
#include "units/SetPoints.hpp"

namespace wr {

/// @brief A sub-system that measures, controls and actuates one part of the robot.
///
/// @function Defines the same sequence of orders in each cycle for every control system. Subclasses define how they
/// carry out each order.
///
/// @secret The sequence of orders in one control cycle of a control system.
///
/// @role{control-system-orders, Abstract Class}
///
/// @patternapp{control-system-orders, Template Method, Main controller orders for control sub-systems}
/// @why The main controller sends the same sequence of orders to all control systems. Each control
/// system executes an order differently.
/// @changes The way in which one system carries out an order may change. A new order is one more step of
/// the sequence.
class ControlSystem {
 public:
  ControlSystem(const ControlSystem&) = delete;
  ControlSystem& operator=(const ControlSystem&) = delete;

  /// @brief Orders the system to measure, to follow the set-points and to start its work.
  /// @param setPoints target of the system
  /// @param cycle number of the control cycle, from 1
  /// @isr{no}
  void control(const SetPoints& setPoints, std::uint32_t cycle);

  /// @brief Orders the system to measure, to stand still and to start its work.
  /// @param cycle number of the control cycle, from 1
  /// @isr{no}
  void hold(std::uint32_t cycle);

  /// @brief Orders the system to measure, to stand still, to release latched faults and to start
  /// its work.
  /// @param cycle number of the control cycle, from 1
  /// @isr{no}
  void acknowledge(std::uint32_t cycle);

  /// @brief Returns whether the work that was ordered for a cycle is done.
  /// @param cycle number of the control cycle, from 1
  /// @return true if the last work that was done is the work of that cycle.
  /// @isr{no}
  [[nodiscard]] virtual bool completed(std::uint32_t cycle) const = 0;

  /// @brief Adds the measured and applied values of the system.
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
