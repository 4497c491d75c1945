#pragma once

#include <cstdint>

#include "main_control/control_systems/ControlSystem.hpp"

namespace wr {

/// @brief A control system that receives the order of a cycle as one call.
///
/// @function Records the order of the cycle while it is given in parts, and passes it on as one call at
/// the activation: follow set-points, hold, or acknowledge.
///
/// @secret How the parts of an order become one call.
///
/// @role{control-system-orders, Abstract Class}
class OrderedSystem : public ControlSystem {
 protected:
  OrderedSystem() = default;
  ~OrderedSystem() = default;

 private:
  enum class Order : std::uint8_t { Follow, Hold, Acknowledge };

  /// @brief Carries out a cycle that follows set-points.
  /// @param setPoints set-points of the cycle
  /// @param cycle number of the cycle
  virtual void follow(const SetPoints& setPoints, std::uint32_t cycle) = 0;

  /// @brief Carries out a cycle that halts the wheels and holds the steering.
  /// @param cycle number of the cycle
  virtual void stand(std::uint32_t cycle) = 0;

  /// @brief Carries out a cycle that releases latched faults and holds.
  /// @param cycle number of the cycle
  virtual void recover(std::uint32_t cycle) = 0;

  void measure() override;
  void apply(const SetPoints& setPoints) override;
  void halt() override;
  void release() override;
  void activate(std::uint32_t cycle) override;

  SetPoints setPoints_{};
  Order order_ = Order::Hold;
};

}  // namespace wr
