#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "sim/k64/VirtualBoard.hpp"
#include "sim/scenario/BoardBinding.hpp"
#include "sim/scenario/RobotLine.hpp"

namespace wr {

/// @brief The image of the firmware on the virtual K64 in the simulated robot. Its line has 115200 baud.
class BoardLine final : public RobotLine {
 public:
  /// @brief Interrupt of the timer that gives the clock pulses: channel 0 of the PIT.
  static constexpr int kPulseInterrupt = 48;

  /// @brief Switches the board on.
  /// @param image what flash holds
  /// @param options what the board does and has
  BoardLine(std::vector<std::uint8_t> image, k64::Options options);

  void send(std::span<const std::uint8_t> bytes) override;
  void sendBeforePulse(std::span<const std::uint8_t> bytes, Time before) override;
  [[nodiscard]] std::vector<std::uint8_t> takeSent() override;
  bool runUntil(Time instant) override;
  bool runThroughPulse() override;
  [[nodiscard]] Time now() const override;
  [[nodiscard]] sim::Robot& robot() override;
  [[nodiscard]] sim::RemoteControl& remoteControl() override;
  void reset(ResetKind kind) override;
  void setExternalClock(bool present) override;
  [[nodiscard]] std::optional<LineFinding> finding() const override;

  /// @brief Sets what is called with each event of the board.
  /// @param call what is called
  void onEvent(std::function<void(const k64::Event&)> call);

  /// @brief Times of the clock pulses, in their order.
  /// @return time at which the handler of each pulse was entered, since the board was switched on
  [[nodiscard]] const std::vector<std::chrono::nanoseconds>& pulses() const { return pulses_; }

  k64::VirtualBoard board;

 private:
  bool settle();

  BoardBinding binding_;
  std::vector<std::chrono::nanoseconds> pulses_;
  std::function<void(const k64::Event&)> observer_;
};

/// @brief Reads an image. Throws std::runtime_error when there is none.
/// @param file the file
/// @return its bytes
[[nodiscard]] std::vector<std::uint8_t> readImage(const std::filesystem::path& file);

}  // namespace wr
