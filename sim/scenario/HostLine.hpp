#pragma once

#include "sim/host/HostSerialPort.hpp"
#include "sim/host/HostWorld.hpp"
#include "sim/scenario/RobotLine.hpp"

namespace wr {

/// @brief The firmware on the host, in stepped time. Its line takes no time.
class HostLine final : public RobotLine {
 public:
  /// @brief Makes the robot. It does not run yet.
  /// @param equipment how much of the firmware it has
  explicit HostLine(HostEquipment equipment = HostEquipment::Whole);

  /// @brief Switches the robot on.
  void start();

  void send(std::span<const std::uint8_t> bytes) override;
  void sendBeforePulse(std::span<const std::uint8_t> bytes, Time before) override;
  [[nodiscard]] std::vector<std::uint8_t> takeSent() override;
  bool runUntil(Time instant) override;
  bool runThroughPulse() override;
  [[nodiscard]] Time now() const override;
  [[nodiscard]] sim::Robot& robot() override;
  [[nodiscard]] sim::RemoteControl& remoteControl() override;
  void reset(ResetKind kind) override;
  [[nodiscard]] std::optional<LineFinding> finding() const override;

  HostSerialPort port;
  HostWorld world;
};

}  // namespace wr
