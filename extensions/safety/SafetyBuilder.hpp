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

/// @brief The builder of one control system: the robot with its safety functions.
///
/// @function Forwards each construction step to the builders of the robot's control systems. Wraps
/// the safety functions around these control systems. At each tick of SecondTimer, executes the
/// tick commands of these control systems.
///
/// @secret The safety functions that wrap the robot, and their sequence.
///
/// @role{wheel-system-construction, Concrete Builder}
/// @role{steering-system-construction, Concrete Builder}
class SafetyBuilder final : public ControlSystemBuilder {
 public:
  /// @brief Builders of the robot, and devices of its safety functions. All these objects must
  /// exist as long as this builder.
  /// @datatype
  struct Parts {
    std::span<WheelSystemBuilder> wheels;            ///< builders of the wheels
    std::span<ControlSystemBuilder* const> systems;  ///< builders of all control systems
    EdgeInput& emergencyStop;    ///< emergency-stop contact; high while it is open
    RetainedProtection& memory;  ///< memory of the protective stop; its begin() was called
  };

  /// @param parts builders of the robot, and devices of its safety functions
  explicit SafetyBuilder(const Parts& parts);

  void buildActuator() override;
  void buildSensors() override;
  /// @brief Builds every controller. The controllers of the wheels get algorithms that limit speed
  /// and current.
  /// @satisfies FR-283
  /// @isr{no}
  void buildController() override;
  /// @brief Builds every control system, and wraps the safety functions around all of them.
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

  /// @brief The command of a tick: samples the emergency-stop contact, then executes the tick
  /// command of every control system.
  class Ticks final : public Command {
   public:
    /// @brief Adds the tick command of a control system.
    /// @param command command that each tick executes
    void add(Command& command);
    /// @brief Sets the contact that each tick samples.
    /// @param contact detector of the emergency-stop contact
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
