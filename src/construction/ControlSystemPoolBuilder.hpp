#pragma once

#include <optional>
#include <span>

#include "construction/ControlSystemBuilder.hpp"
#include "devices/PeriodicTimer.hpp"
#include "devices/SecondTimer.hpp"
#include "main_control/control_systems/ControlSystemPool.hpp"

namespace wr {

/// @brief Builds the pool of control systems.
///
/// @function Builds each control system, adds it to the pool, and passes its command to the second
/// timer.
///
/// @secret The sequence in which the control systems are built and put into the pool, and where the
/// pool is stored.
///
/// @role{pool-construction, Builder}
/// @role{pool-construction, Concrete Builder}
/// @role{wheel-system-construction, Director}
/// @role{steering-system-construction, Director}
///
/// @patternapp{pool-construction, Builder, Building a control system pool}
/// @why The pool that gets the orders of the main controller contains several control systems.
/// The user of the pool does not depend on how it is filled.
/// @changes New control systems may have to be added to the pool, without change to the main controller.
class ControlSystemPoolBuilder {
 public:
  /// @brief Binds the builder to the builders of the control systems. Nothing is built yet.
  /// @param tickTimer generates the ticks of the second timer
  /// @param builders build the control systems, in the sequence of the pool; they exist as long as
  /// this builder
  ControlSystemPoolBuilder(PeriodicTimer& tickTimer,
                           std::span<ControlSystemBuilder* const> builders);
  ControlSystemPoolBuilder(const ControlSystemPoolBuilder&) = delete;
  ControlSystemPoolBuilder& operator=(const ControlSystemPoolBuilder&) = delete;

  /// @brief Builds each control system.
  /// @errors A part that is built twice ends the program with the assertion PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  void buildSystems();

  /// @brief Builds the pool and puts all control systems into it.
  /// @pre The control systems are built.
  /// @post pool() can be called.
  /// @errors A missing system ends the program with the assertion PartMissing. A second pool ends
  /// the program with PartBuiltTwice.
  /// @satisfies FR-78
  /// @isr{no}
  void buildPool();

  /// @brief Builds the second timer and passes it the command of each control system.
  /// @pre The control systems are built.
  /// @errors A missing system ends the program with the assertion PartMissing. A second timer ends
  /// the program with PartBuiltTwice.
  /// @satisfies FR-100
  /// @satisfies FR-78
  /// @isr{no}
  void buildTimer();

  /// @brief Starts the control systems, then the second timer.
  /// @pre The control systems and the timer are built.
  /// @errors A missing part ends the program with the assertion PartMissing.
  /// @satisfies FR-100
  /// @isr{no}
  void start();

  /// @brief Returns the pool that was built.
  /// @return the pool; it exists as long as the builder.
  /// @pre buildPool() was called.
  /// @errors Without a pool the program ends with the assertion PartMissing.
  /// @isr{no}
  /// @satisfies FR-78
  [[nodiscard]] ControlSystemPool& pool();

  /// @brief Returns the second timer that was built.
  /// @return the timer; it exists as long as the builder.
  /// @pre buildTimer() was called.
  /// @errors Without a timer the program ends with the assertion PartMissing.
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
