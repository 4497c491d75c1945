#pragma once

#include <cstdint>

#include "units/Measurements.hpp"
#include "units/SetPoints.hpp"

namespace wr {

/// @brief One of the stages that each order passes on its way to the control systems.
///
/// @function Receives the order of each cycle in one call, and returns the measurements of the
/// cycle.
///
/// @secret The change that a stage makes to an order.
class OrderStage {
 public:
  OrderStage(const OrderStage&) = delete;
  OrderStage& operator=(const OrderStage&) = delete;

  /// @brief Executes an order to follow set-points.
  /// @param setPoints set-points of the cycle
  /// @param cycle number of the cycle
  /// @isr{no}
  virtual void follow(const SetPoints& setPoints, std::uint32_t cycle) = 0;

  /// @brief Executes an order to halt the wheels and to hold the steering.
  /// @param cycle number of the cycle
  /// @isr{no}
  virtual void stand(std::uint32_t cycle) = 0;

  /// @brief Executes an order to release latched faults. In this cycle the wheels halt and the
  /// steering keeps its angle.
  /// @param cycle number of the cycle
  /// @isr{no}
  virtual void recover(std::uint32_t cycle) = 0;

  /// @brief Checks whether all control systems have executed the orders of a cycle.
  /// @param cycle number of the cycle
  /// @return true if all orders of this cycle have been executed.
  /// @isr{no}
  [[nodiscard]] virtual bool completed(std::uint32_t cycle) const = 0;

  /// @brief Writes the measurements and outputs of this cycle. They replace the values of an
  /// earlier cycle.
  /// @param measurements receives the measurements
  /// @param outputs receives the outputs
  /// @isr{no}
  virtual void collect(Measurements& measurements, Outputs& outputs) const = 0;

 protected:
  OrderStage() = default;
  ~OrderStage() = default;
};

}  // namespace wr
