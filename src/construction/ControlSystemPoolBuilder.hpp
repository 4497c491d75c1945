#pragma once

#include <optional>

#include "main_control/control_systems/ControlSystemPool.hpp"

namespace wr {

/// @brief Makes the pool of control systems.
///
/// @function Makes the pool in its own storage and hands it out.
///
/// @secret Which control systems are in the pool, and where they are stored.
///
/// @role{pool-construction, Builder}
/// @role{pool-construction, Concrete Builder}
///
/// @patternapp{pool-construction, Builder, Building a control system pool}
/// @why The pool that the main controller orders holds several control systems. Whoever uses the pool
/// needs not to know how it comes to them.
/// @changes New control systems may have to be added to the pool, without change to the main controller.
class ControlSystemPoolBuilder {
 public:
  /// @brief Makes a builder that has built nothing.
  ControlSystemPoolBuilder() = default;
  ControlSystemPoolBuilder(const ControlSystemPoolBuilder&) = delete;
  ControlSystemPoolBuilder& operator=(const ControlSystemPoolBuilder&) = delete;

  /// @brief Makes the pool.
  /// @post pool() can be called.
  /// @isr{no}
  void buildPool();

  /// @brief The pool that was made.
  /// @return the pool; it lives as long as the builder.
  /// @pre buildPool() was called.
  /// @errors Without a pool the program ends with the assertion PartMissing.
  /// @isr{no}
  [[nodiscard]] ControlSystemPool& pool();

 private:
  std::optional<ControlSystemPool> pool_;
};

}  // namespace wr
