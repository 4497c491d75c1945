#pragma once

#include <optional>
#include <span>

#include "construction/ControlSystemBuilder.hpp"
#include "devices/PeriodicTimer.hpp"
#include "devices/SecondTimer.hpp"
#include "main_control/control_systems/ControlSystemPool.hpp"

namespace wr {

/// @brief Builder of the pool of control systems.
///
/// @function Builds each control system and adds this system to the pool. Passes the tick command
/// of each system to SecondTimer, the timer of the ticks.
///
/// @secret The sequence in which the control systems are built and added to the pool, and the
/// storage of the pool.
///
/// @role{pool-construction, Builder}
/// @role{pool-construction, Concrete Builder}
/// @role{wheel-system-construction, Director}
/// @role{steering-system-construction, Director}
///
/// @patternapp{pool-construction, Builder, Building a control system pool}
/// @why The pool contains several control systems and receives the orders of the main controller
/// for these systems. The main controller does not depend on the steps that fill the pool.
/// @changes New control systems may have to be added to the pool. Adding them does not change the
/// main controller.
class ControlSystemPoolBuilder {
 public:
  /// @param tickTimer generates the ticks of SecondTimer
  /// @param builders builders of the control systems, in the sequence in which the systems are
  /// added to the pool; these builders must exist as long as this object
  ControlSystemPoolBuilder(PeriodicTimer& tickTimer,
                           std::span<ControlSystemBuilder* const> builders);
  ControlSystemPoolBuilder(const ControlSystemPoolBuilder&) = delete;
  ControlSystemPoolBuilder& operator=(const ControlSystemPoolBuilder&) = delete;

  /// @brief Builds each control system.
  /// @errors If a part is built twice, the program ends with the assertion PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  void buildSystems();

  /// @brief Builds the pool and adds all control systems to it.
  /// @pre The control systems are built.
  /// @post pool() can be called.
  /// @errors If a control system is missing, the program ends with the assertion PartMissing. If
  /// the pool is built twice, the program ends with PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  void buildPool();

  /// @brief Builds SecondTimer and adds the tick command of each control system to it.
  /// @pre The control systems are built.
  /// @errors If a control system is missing, the program ends with the assertion PartMissing. If
  /// SecondTimer is built twice, the program ends with PartBuiltTwice.
  /// @satisfies FR-100
  /// @satisfies FR-78
  /// @isr{no}
  void buildTimer();

  /// @brief Starts the control systems, and then SecondTimer.
  /// @pre The control systems and SecondTimer are built.
  /// @errors If a part is missing, the program ends with the assertion PartMissing.
  /// @satisfies FR-100
  /// @isr{no}
  void start();

  /// @brief Returns the pool that was built.
  /// @return the pool; it exists as long as the builder.
  /// @pre buildPool() was called.
  /// @errors If the pool is not built, the program ends with the assertion PartMissing.
  /// @isr{no}
  /// @satisfies FR-78
  [[nodiscard]] ControlSystemPool& pool();

  /// @brief Returns the SecondTimer that was built.
  /// @return the timer; it exists as long as the builder.
  /// @pre buildTimer() was called.
  /// @errors If the timer is not built, the program ends with the assertion PartMissing.
  /// @isr{yes}
  /// @satisfies FR-78
  [[nodiscard]] SecondTimer& timer();

 private:
  PeriodicTimer& tickTimer_;
  std::span<ControlSystemBuilder* const> builders_;
  std::optional<ControlSystemPool> pool_;
  std::optional<SecondTimer> timer_;
};

}  // namespace wr
