#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "sim/plant/RemoteControl.hpp"
#include "sim/plant/Robot.hpp"

namespace wr::scenario {

/// @brief The finding with which a simulated board has stopped.
struct SessionFinding {
  std::string id;    ///< kind of the finding
  std::string text;  ///< the whole finding as one line of text
};

/// @brief A reset of the microcontroller from outside.
enum class ResetKind : std::uint8_t {
  Pin,   ///< a reset by the pin; memory keeps its content
  Power  ///< the supply was off; memory loses its content
};

/// @brief A robot whose time advances only when the caller runs the robot, for example with
/// runUntil(). The caller has the role of the PC on the serial line.
class RobotSession {
 public:
  /// @brief Time since the robot was switched on.
  using Time = std::chrono::microseconds;

  RobotSession() = default;
  RobotSession(const RobotSession&) = delete;
  RobotSession& operator=(const RobotSession&) = delete;
  virtual ~RobotSession() = default;

  /// @brief Sends bytes to the robot, one after the other.
  virtual void send(std::span<const std::uint8_t> bytes) = 0;

  /// @brief Sends bytes to the robot. The last byte is complete at a given time before the next
  /// clock pulse. There must have been at least one clock pulse.
  /// @param bytes the bytes
  /// @param before time before the pulse
  virtual void sendBeforePulse(std::span<const std::uint8_t> bytes, Time before) = 0;

  /// @brief Returns the bytes that the robot has sent since the last call.
  /// @return the bytes, oldest first
  [[nodiscard]] virtual std::vector<std::uint8_t> takeSent() = 0;

  /// @brief Advances the time to an instant.
  /// @param instant the instant
  /// @return false if a finding has stopped the robot
  virtual bool runUntil(Time instant) = 0;

  /// @brief Runs to the next clock pulse, then to the end of its cycle, and then until all bytes
  /// are sent.
  /// @return false if a finding has stopped the robot
  virtual bool runThroughPulse() = 0;

  /// @brief Returns the present time.
  /// @return time since the robot was switched on
  [[nodiscard]] virtual Time now() const = 0;

  /// @brief Returns the physics of the robot.
  /// @return the physics; the caller reads true values, and changes the ground, the noise and the
  /// faults
  [[nodiscard]] virtual plant::Robot& robot() = 0;

  /// @brief Returns the remote control.
  /// @return the remote control; at first, only its enable switch is connected
  [[nodiscard]] virtual plant::RemoteControl& remoteControl() = 0;

  /// @brief Resets the microcontroller. Throws std::runtime_error if this is not possible.
  /// @param kind cause of the reset
  virtual void reset(ResetKind /*kind*/) {
    throw std::runtime_error(
        "this robot cannot be reset; play the scenario with the whole firmware");
  }

  /// @brief Stops or starts the external clock of 50 MHz. Throws std::runtime_error if the robot
  /// has no such clock.
  /// @param present false: the clock is lost
  virtual void setExternalClock(bool /*present*/) {
    throw std::runtime_error(
        "the host has no external clock; play the scenario on the virtual board");
  }

  /// @brief Returns the finding that has stopped the robot.
  /// @return the finding; nothing while there is no finding
  [[nodiscard]] virtual std::optional<SessionFinding> finding() const = 0;
};

}  // namespace wr::scenario
