#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <vector>

#include "sim/board_robot/BoardWires.hpp"
#include "sim/emulator/VirtualBoard.hpp"
#include "sim/scenario/RobotSession.hpp"

namespace wr::board_robot {

/// @brief The firmware image on the virtual K64 in the simulated robot. The serial line to the PC
/// has 115200 baud.
class BoardSession final : public scenario::RobotSession {
 public:
  /// @brief Interrupt of channel 0 of the PIT, which generates the clock pulses.
  static constexpr int kPulseInterrupt = 48;

  /// @brief Switches the board on.
  /// @param image firmware image, which is the content of the flash
  /// @param options options of the board
  BoardSession(std::vector<std::uint8_t> image, emulator::Options options);

  void send(std::span<const std::uint8_t> bytes) override;
  void sendBeforePulse(std::span<const std::uint8_t> bytes, Time before) override;
  [[nodiscard]] std::vector<std::uint8_t> takeSent() override;
  bool runUntil(Time instant) override;
  bool runThroughPulse() override;
  [[nodiscard]] Time now() const override;
  [[nodiscard]] plant::Robot& robot() override;
  [[nodiscard]] plant::RemoteControl& remoteControl() override;
  void reset(scenario::ResetKind kind) override;
  void setExternalClock(bool present) override;
  [[nodiscard]] std::optional<scenario::SessionFinding> finding() const override;

  /// @brief Sets the callback for each event of the board.
  void onEvent(std::function<void(const emulator::Event&)> call);

  /// @brief Returns the times of the clock pulses, oldest first.
  /// @return time from power-on to the entry of the handler, for each pulse
  [[nodiscard]] const std::vector<std::chrono::nanoseconds>& pulses() const { return pulses_; }

  emulator::VirtualBoard board;

 private:
  bool settle();

  BoardWires binding_;
  std::vector<std::chrono::nanoseconds> pulses_;
  std::function<void(const emulator::Event&)> observer_;
};

}  // namespace wr::board_robot
