#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "main_control/control_systems/ControlSystem.hpp"
#include "units/Measurements.hpp"
#include "units/SetPoints.hpp"

namespace wr {

/// @brief All control systems of the robot.
///
/// @function Passes each order of the main controller to all control systems, from the first added
/// system to the last. Collects the measured and applied values of the systems.
///
/// @secret The storage of the control systems, and the sequence in which they get orders.
///
/// @role{pool-construction, Product}
class ControlSystemPool {
 public:
  /// @brief Largest number of control systems: four wheels, the steering, and three spare entries.
  static constexpr std::size_t kCapacity = 8;

  /// @brief Constructs an empty pool.
  ControlSystemPool() = default;
  ControlSystemPool(const ControlSystemPool&) = delete;
  ControlSystemPool& operator=(const ControlSystemPool&) = delete;

  /// @brief Adds a control system.
  /// @param system control system; it must exist for as long as the pool exists
  /// @errors If the pool is full, the assertion PoolFull ends the program.
  /// @isr{no}
  /// @satisfies FR-176
  void add(ControlSystem& system);

  /// @brief Orders all control systems to follow the set-points.
  /// @param setPoints set-points of the control systems
  /// @param cycle number of the control cycle; the first cycle has the number 1
  /// @isr{no}
  void control(const SetPoints& setPoints, std::uint32_t cycle);

  /// @brief Orders all control systems to stand still.
  /// @param cycle number of the control cycle; the first cycle has the number 1
  /// @isr{no}
  void hold(std::uint32_t cycle);

  /// @brief Orders all control systems to stand still and to release latched faults.
  /// @param cycle number of the control cycle; the first cycle has the number 1
  /// @isr{no}
  void acknowledge(std::uint32_t cycle);

  /// @brief Checks whether all control systems have completed the work of a cycle.
  /// @param cycle number of the control cycle; the first cycle has the number 1
  /// @return true if every control system has completed its work, or if the pool is empty.
  /// @satisfies FR-5
  /// @isr{no}
  [[nodiscard]] bool completed(std::uint32_t cycle) const;

  /// @brief Collects the measured and applied values of the control systems.
  /// @param measurements receives the measured values; if no system measures a value, it stays
  /// missing
  /// @param outputs receives the applied values; if no system applies a value, it stays missing
  /// @satisfies FR-62
  /// @isr{no}
  void collect(Measurements& measurements, Outputs& outputs) const;

 private:
  [[nodiscard]] std::span<ControlSystem* const> systems() const;

  std::array<ControlSystem*, kCapacity> systems_{};
  std::size_t count_ = 0;
};

}  // namespace wr
