#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "construction/ControlSystemBuilder.hpp"
#include "construction/WheelSystemBuilder.hpp"
#include "devices/EdgeInput.hpp"
#include "safety/Arming.hpp"
#include "safety/ContactWatch.hpp"
#include "safety/LimitedAlgorithms.hpp"
#include "safety/ProtectiveStop.hpp"
#include "safety/RetainedProtection.hpp"
#include "safety/RobotStage.hpp"
#include "safety/SafeSystem.hpp"
#include "safety/SetPointRamp.hpp"
#include "services/Command.hpp"
#include "units/SetPoints.hpp"

namespace wr {

/// @brief Builds the robot and its safety functions as a single control system.
///
/// @function Calls each step of the builders of the robot's control systems, wraps their products
/// in the safety functions of the control cycle, and forwards ticks to them.
///
/// @secret Which safety functions wrap the robot, and in which sequence.
///
/// @role{wheel-system-construction, Concrete Builder}
/// @role{steering-system-construction, Concrete Builder}
class SafetyBuilder final : public ControlSystemBuilder {
 public:
  /// @brief Builders of the robot and devices of its safety functions. Each exists as long as this builder.
  /// @datatype
  struct Parts {
    std::span<WheelSystemBuilder> wheels;            ///< builders of the wheels
    std::span<ControlSystemBuilder* const> systems;  ///< builders of all control systems
    EdgeInput& emergencyStop;    ///< contact of the emergency-stop circuit; high: active
    RetainedProtection& memory;  ///< memory of the protective stop; begin() was called
  };

  /// @brief Binds the builder to the builders of the robot.
  /// @param parts builders of the robot
  explicit SafetyBuilder(const Parts& parts);

  void buildActuator() override;
  void buildSensors() override;
  /// @brief Builds every controller; the controllers of the wheels get algorithms with a speed
  /// limit.
  /// @satisfies FR-283
  /// @isr{no}
  void buildController() override;
  /// @brief Builds every control system, and wraps the control systems in the safety functions.
  /// @satisfies FR-293
  /// @isr{no}
  void buildSystem() override;
  void start() override;
  [[nodiscard]] ControlSystem& system() override;
  [[nodiscard]] Command& tickCommand() override;

 private:
  struct Chain {
    Chain(OrderStage& robot, const Parts& parts);
    ContactWatch emergencyStop;
    ProtectiveStop protectiveStop;
    SetPointRamp ramp;
    Arming arming;
    SafeSystem system;
  };

  /// @brief Executes the tick command of every control system, and samples the contact.
  class Ticks final : public Command {
   public:
    /// @brief Adds a command.
    /// @param command executed at each tick
    void add(Command& command);
    /// @brief Sets the contact that is sampled at each tick.
    /// @param contact the contact
    void watch(ContactWatch& contact);
    void execute() override;

   private:
    std::array<Command*, RobotStage::kCapacity> commands_{};
    std::size_t count_ = 0;
    ContactWatch* contact_ = nullptr;
  };

  Parts parts_;
  std::array<LimitedAlgorithms, kWheelCount> algorithms_;
  RobotStage robot_;
  Ticks ticks_;
  std::optional<Chain> chain_;
};

}  // namespace wr
