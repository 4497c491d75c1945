#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/board_robot/BoardSession.hpp"

namespace wr::can {

/// @brief A session with a robot on the virtual K64. The PC is another node of the CAN bus.
/// Everything else is the same as with the serial line.
class CanSession final : public scenario::RobotSession {
 public:
  /// @param board board whose firmware image uses the CAN bus
  explicit CanSession(std::unique_ptr<board_robot::BoardSession> board) : all_(std::move(board)) {}

  void send(std::span<const std::uint8_t> bytes) override;
  void sendBeforePulse(std::span<const std::uint8_t> bytes, Time before) override;
  [[nodiscard]] std::vector<std::uint8_t> takeSent() override;
  bool runUntil(Time instant) override { return all_->runUntil(instant); }
  bool runThroughPulse() override;
  [[nodiscard]] Time now() const override { return all_->now(); }
  [[nodiscard]] plant::Robot& robot() override { return all_->robot(); }
  [[nodiscard]] plant::RemoteControl& remoteControl() override { return all_->remoteControl(); }
  void reset(scenario::ResetKind kind) override { all_->reset(kind); }
  [[nodiscard]] std::optional<scenario::SessionFinding> finding() const override {
    return all_->finding();
  }

 private:
  std::unique_ptr<board_robot::BoardSession> all_;
};

}  // namespace wr::can
