#pragma once

#include <cstdint>

#include "units/Measurements.hpp"
#include "units/SetPoints.hpp"

namespace wr {

/// @brief A stage on the path of an order to the control systems.
///
/// @function Receives the order of each cycle as one call, and returns the measurements of the cycle.
///
/// @secret How a stage changes an order before forwarding it.
class OrderStage {
 public:
  OrderStage(const OrderStage&) = delete;
  OrderStage& operator=(const OrderStage&) = delete;

  /// @brief Executes a cycle that follows set-points.
  /// @param setPoints set-points of the cycle
  /// @param cycle number of the cycle
  /// @isr{no}
  virtual void follow(const SetPoints& setPoints, std::uint32_t cycle) = 0;

  /// @brief Executes a cycle that halts the wheels and holds the steering.
  /// @param cycle number of the cycle
  /// @isr{no}
  virtual void stand(std::uint32_t cycle) = 0;

  /// @brief Executes a cycle that releases latched faults and holds the robot.
  /// @param cycle number of the cycle
  /// @isr{no}
  virtual void recover(std::uint32_t cycle) = 0;

  /// @brief Checks whether the orders of a cycle have been carried out.
  /// @param cycle number of the cycle
  /// @return true if all orders have been carried out.
  /// @isr{no}
  [[nodiscard]] virtual bool completed(std::uint32_t cycle) const = 0;

  /// @brief Replaces the measurements and outputs of an earlier cycle by the values of this cycle.
  /// @param measurements receives the measurements
  /// @param outputs receives the outputs
  /// @isr{no}
  virtual void collect(Measurements& measurements, Outputs& outputs) const = 0;

 protected:
  OrderStage() = default;
  ~OrderStage() = default;
};

}  // namespace wr
