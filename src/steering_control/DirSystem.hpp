#pragma once

#include <cstdint>
#include <optional>

#include "devices/Timebase.hpp"
#include "main_control/control_systems/ControlSystem.hpp"
#include "services/Pipe.hpp"
#include "steering_control/DirController.hpp"
#include "units/Measurements.hpp"
#include "units/SetPoints.hpp"

namespace wr {

/// @brief The control system of the steering.
///
/// @function Passes the ordered angle, or the order to hold, to the controller of the steering.
/// Reports the status of the steering to Main Control.
///
/// @secret The exchange of orders and values between the control cycle and the faster tick of the
/// steering.
///
/// @role{control-system-orders, Concrete Class}
/// @role{steering-system-construction, Product}
class DirSystem final : public ControlSystem {
 public:
  /// @brief Parts of the system. Each part must exist for as long as the system exists.
  /// @datatype
  struct Parts {
    Pipe<DirTarget>& target;   ///< receives the orders
    Pipe<DirStatus>& status;   ///< pipe of the status of the steering
    const Timebase& timebase;  ///< returns the present time
  };

  /// @param parts parts of the system
  explicit DirSystem(const Parts& parts);

  /// @brief Checks whether two conditions are met: the order of a cycle was passed to the steering,
  /// and the steering still executes its ticks.
  /// @param cycle number of the control cycle; the first cycle has the number 1
  /// @return true if the last order was passed in this cycle, and the status of the steering was at
  /// most 20 ms old when it was read.
  /// @isr{no}
  /// @satisfies FR-117
  [[nodiscard]] bool completed(std::uint32_t cycle) const override;

  /// @brief Writes the position, the state, the end stops and the turn of the steering, as they
  /// were measured in this cycle.
  /// @param measurements receives the measured values; a position older than 150 ms is missing
  /// @param outputs receives the turn, which is missing if the steering does not execute its ticks
  /// @isr{no}
  /// @satisfies FR-116
  void collect(Measurements& measurements, Outputs& outputs) const override;

 private:
  /// @brief Reads the newest status of the steering.
  /// @satisfies FR-116
  /// @satisfies FR-127
  void measure() override;

  /// @brief Records the ordered angle.
  /// @param setPoints set-points that contain the ordered angle
  /// @satisfies FR-115
  void apply(const SetPoints& setPoints) override;

  /// @brief Records the order to hold.
  /// @satisfies FR-115
  void halt() override;

  /// @brief Records that the next order also releases a fault.
  /// @satisfies FR-112
  void release() override;

  /// @brief Passes the recorded order to the controller of the steering.
  /// @param cycle number of the control cycle; the first cycle has the number 1
  /// @satisfies FR-115
  void activate(std::uint32_t cycle) override;

  Pipe<DirTarget>& targets_;
  Pipe<DirStatus>& statuses_;
  const Timebase& timebase_;
  DirTarget target_{};
  DirStatus status_{};  // status that was read in this cycle
  bool ticks_ = false;  // this status was at most 20 ms old when it was read
  std::uint32_t cycle_ = 0;
};

}  // namespace wr
