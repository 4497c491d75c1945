#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/scenario/RobotSession.hpp"

namespace wr::web {

/// @brief A robot session that records the bytes on the serial line.
class RecordedLine final : public scenario::RobotSession {
 public:
  /// @brief Bytes that one side has sent.
  struct Piece {
    Time at;                          ///< time at which the PC sent or read the bytes
    bool fromPc;                      ///< false: the robot sent the bytes
    std::vector<std::uint8_t> bytes;  ///< never empty
  };

  explicit RecordedLine(scenario::RobotSession& robot) : robot_(robot) {}

  void send(std::span<const std::uint8_t> bytes) override;
  void sendBeforePulse(std::span<const std::uint8_t> bytes, Time before) override;
  [[nodiscard]] std::vector<std::uint8_t> takeSent() override;
  bool runUntil(Time instant) override { return robot_.runUntil(instant); }
  bool runThroughPulse() override { return robot_.runThroughPulse(); }
  [[nodiscard]] Time now() const override { return robot_.now(); }
  [[nodiscard]] plant::Robot& robot() override { return robot_.robot(); }
  [[nodiscard]] plant::RemoteControl& remoteControl() override { return robot_.remoteControl(); }
  void reset(scenario::ResetKind kind) override { robot_.reset(kind); }
  void setExternalClock(bool present) override { robot_.setExternalClock(present); }
  [[nodiscard]] std::optional<scenario::SessionFinding> finding() const override {
    return robot_.finding();
  }

  /// @brief Returns the pieces that were recorded since the last call, oldest first.
  [[nodiscard]] std::vector<Piece> takePieces();

 private:
  void note(bool fromPc, std::span<const std::uint8_t> bytes);

  scenario::RobotSession& robot_;
  std::vector<Piece> pieces_;
};

}  // namespace wr::web
