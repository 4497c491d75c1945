#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ports/mps2/tests/Emulator.hpp"
#include "sim/emulator/Symbols.hpp"
#include "sim/scenario/RobotSession.hpp"

namespace wr::mps2 {

/// @brief A session with the firmware on the emulated board. The board has no motors and no
/// sensors, and its time advances step by step. send() passes bytes to the robot at once.
/// sendBeforePulse() passes bytes up to 80 ms earlier than requested. The sleep instruction is
/// replaced, because during a sleep QEMU uses the time of the host computer.
class QemuSession final : public scenario::RobotSession {
 public:
  /// @brief Switches the robot on, and returns when its firmware is at rest for the first time.
  /// @param elf path of the ELF file of the firmware
  explicit QemuSession(const std::filesystem::path& elf);

  void send(std::span<const std::uint8_t> bytes) override;
  void sendBeforePulse(std::span<const std::uint8_t> bytes, Time before) override;
  [[nodiscard]] std::vector<std::uint8_t> takeSent() override;
  bool runUntil(Time instant) override;
  bool runThroughPulse() override;
  [[nodiscard]] Time now() const override { return now_; }
  [[nodiscard]] plant::Robot& robot() override;
  [[nodiscard]] plant::RemoteControl& remoteControl() override;
  [[nodiscard]] std::optional<scenario::SessionFinding> finding() const override;

 private:
  [[nodiscard]] std::uint32_t placeOf(const std::string& symbol) const;
  void run(std::initializer_list<std::uint32_t> places);

  emulator::Symbols symbols_;
  std::uint32_t rest_;
  std::uint32_t tick_;
  std::uint32_t cycle_;
  std::uint32_t end_;
  Emulator emulator_;
  std::uint32_t place_ = 0;  // address of the instruction at which the firmware is stopped
  std::uint32_t counter_ = 0xFFFF'FFFF;
  std::uint64_t ticks_ = 0;
  Time now_{0};
  Time lastPulse_{0};
};

}  // namespace wr::mps2
