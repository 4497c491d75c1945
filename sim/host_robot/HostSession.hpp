#pragma once

#include "sim/host/HostSerialPort.hpp"
#include "sim/host_robot/HostSimulation.hpp"
#include "sim/scenario/RobotSession.hpp"

namespace wr::host_robot {

/// @brief A robot with the firmware on the host. Its time advances only while the caller runs the
/// robot. Transfers on the serial line to the PC take no time.
class HostSession final : public scenario::RobotSession {
 public:
  /// @brief Constructs the robot. The robot runs only after start().
  /// @param equipment parts of the firmware
  explicit HostSession(host::HostEquipment equipment = host::HostEquipment::Whole);

  /// @brief Switches the robot on.
  void start();

  void send(std::span<const std::uint8_t> bytes) override;
  void sendBeforePulse(std::span<const std::uint8_t> bytes, Time before) override;
  [[nodiscard]] std::vector<std::uint8_t> takeSent() override;
  bool runUntil(Time instant) override;
  bool runThroughPulse() override;
  [[nodiscard]] Time now() const override;
  [[nodiscard]] plant::Robot& robot() override;
  [[nodiscard]] plant::RemoteControl& remoteControl() override;
  void reset(scenario::ResetKind kind) override;
  [[nodiscard]] std::optional<scenario::SessionFinding> finding() const override;

  host::HostSerialPort port;
  HostSimulation world;
};

}  // namespace wr::host_robot
