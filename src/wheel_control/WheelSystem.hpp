#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "main_control/control_systems/ControlSystem.hpp"
#include "services/Command.hpp"
#include "services/ControlThread.hpp"
#include "wheel_control/orders/WheelOrder.hpp"

namespace wr {

/// @brief The control system of one wheel.
///
/// @function Records each order of the main controller, executes the order in the thread of the
/// wheel, and returns the measured and applied values.
///
/// @secret The conversion of orders of the main controller to orders of a wheel, and the use of one
/// thread for each wheel. This thread has a higher priority than the main thread. The main thread
/// never runs while the thread of a wheel is active. Therefore each of the two threads reads only
/// values that the other thread has written completely.
///
/// @role{control-system-orders, Concrete Class}
/// @role{wheel-orders, Context}
/// @role{wheel-system-construction, Product}
class WheelSystem final : public ControlSystem {
 public:
  /// @brief Parts of the system. Each part must exist for as long as the system exists.
  /// @datatype
  struct Parts {
    std::size_t wheel;             ///< number of the wheel, 0 to 3
    ControlThread& thread;         ///< executes the orders
    WheelOrder& readVelocity;      ///< the first order of a cycle
    WheelOrder& registerPosition;  ///< the second order of a cycle
    WheelOrder& readCurrent;       ///< the third order of a cycle
    WheelOrder& applyControl;      ///< the last order of a cycle, if the wheel follows a set-point
    WheelOrder& haltWheel;         ///< the last order of a cycle, if the wheel is halted
  };

  /// @brief Constructs a system that does nothing before start().
  /// @param parts parts of the system
  explicit WheelSystem(const Parts& parts);

  /// @brief Starts the thread. Each activation of the thread executes the orders of one cycle.
  /// @pre The method was not called before.
  /// @errors A second call ends the program with the assertion ThreadStartedTwice.
  /// @satisfies FR-92
  /// @isr{no}
  void start();

  /// @brief Checks whether the orders of a cycle were executed.
  /// @param cycle number of the control cycle; the first cycle has the number 1
  /// @return true if the last executed orders are the orders of this cycle
  /// @satisfies FR-5
  /// @satisfies FR-74
  /// @isr{no}
  [[nodiscard]] bool completed(std::uint32_t cycle) const override;

  /// @brief Writes the measured and applied values of this wheel.
  /// @param measurements receives the measured values; values of other systems do not change
  /// @param outputs receives the applied voltage; values of other systems do not change
  /// @satisfies FR-93
  /// @satisfies FR-94
  /// @isr{no}
  void collect(Measurements& measurements, Outputs& outputs) const override;

 private:
  /// Command that each activation of the thread executes.
  class Body final : public Command {
   public:
    explicit Body(WheelSystem& system);
    void execute() override;

   private:
    WheelSystem& system_;
  };

  void measure() override;
  void apply(const SetPoints& setPoints) override;
  void halt() override;
  void release() override;
  /// @satisfies FR-92
  void activate(std::uint32_t cycle) override;
  void note(WheelOrder& order);
  void work();

  Body body_;
  Parts parts_;
  std::array<WheelOrder*, 4> orders_{};  // the main thread writes the orders, the wheel's thread
                                         // executes them
  std::size_t count_ = 0;                // number of orders
  WheelWork work_;                       // the wheel's thread writes the results, the main thread
                                         // reads them
  std::uint32_t cycle_ = 0;              // number of the cycle of the written orders
  std::atomic<std::uint32_t> completed_{0};  // number of the last cycle whose orders were executed
};

}  // namespace wr
