#pragma once

#include <cstdint>

#include "safety/OrderedSystem.hpp"

namespace wr {

/// @brief A control system that extends another control system.
///
/// @function Passes every order on to the control system that it wraps, and returns its measurements.
/// Derived classes change the orders that they extend.
///
/// @secret Which orders of the wrapped control system pass unchanged.
///
/// @role{control-system-orders, Abstract Class}
class ControlSystemDecorator : public OrderedSystem {
 public:
  /// @brief Checks whether the wrapped control system has carried out the orders of a cycle.
  /// @param cycle number of the cycle
  /// @return true if it has.
  /// @satisfies FR-293
  /// @isr{no}
  [[nodiscard]] bool completed(std::uint32_t cycle) const override;

  /// @brief Adds the measurements and outputs of the wrapped control system.
  /// @param measurements receives the measurements
  /// @param outputs receives the outputs
  /// @satisfies FR-293
  /// @isr{no}
  void collect(Measurements& measurements, Outputs& outputs) const override;

 protected:
  /// @brief Binds the decorator to the control system that it extends.
  /// @param wrapped the extended control system
  explicit ControlSystemDecorator(ControlSystem& wrapped);
  ~ControlSystemDecorator() = default;

  /// @brief Returns the wrapped control system.
  /// @return control system that the decorator extends.
  /// @isr{no}
  [[nodiscard]] ControlSystem& wrapped() const;

 private:
  void follow(const SetPoints& setPoints, std::uint32_t cycle) override;
  void stand(std::uint32_t cycle) override;
  void recover(std::uint32_t cycle) override;

  ControlSystem& wrapped_;
};

}  // namespace wr
