#pragma once

#include <optional>
#include "construction/ControlSystemBuilder.hpp"
#include "services/assertion.hpp"
#include "wheel-system-construction/RelayWheelSystem.hpp"

namespace wr {

/// @brief The builder of the control system of a wheel whose motor is switched by a relay. This
/// system has no sensor and no controller.
class RelayWheelBuilder final : public ControlSystemBuilder {
 public:
  /// @param relay output of the relay; the motor runs while this output is on
  explicit RelayWheelBuilder(DigitalOutput& relay) : relay_(relay) {}

  /// @brief Does nothing, because the constructor has received the relay.
  /// @isr{no}
  void buildActuator() override {}

  /// @brief Does nothing, because there is no sensor.
  /// @isr{no}
  void buildSensors() override {}

  /// @brief Does nothing, because there is no controller.
  /// @isr{no}
  void buildController() override {}

  /// @brief Builds the system.
  /// @errors If the system is already built, the program ends with the assertion PartBuiltTwice.
  /// @isr{no}
  void buildSystem() override {
    require(!system_, AssertId::PartBuiltTwice);
    system_.emplace(relay_);
  }

  /// @brief Switches the relay off.
  /// @isr{no}
  void start() override { relay_.set(false); }

  /// @brief Returns the system.
  /// @return the system; it exists as long as the builder
  /// @errors If the system is not built, the program ends with the assertion PartMissing.
  /// @isr{no}
  [[nodiscard]] ControlSystem& system() override {
    require(system_.has_value(), AssertId::PartMissing);
    return *system_;
  }

  /// @brief Returns the command that is executed at each tick. The command does nothing.
  /// @return the command; it exists as long as the builder
  /// @isr{no}
  [[nodiscard]] Command& tickCommand() override { return none_; }

 private:
  class NoWork final : public Command {
   public:
    void execute() override {}
  };

  DigitalOutput& relay_;
  NoWork none_;
  std::optional<RelayWheelSystem> system_;
};

}  // namespace wr
