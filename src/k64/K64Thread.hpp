#pragma once

#include <cstdint>

#include "k64/core.hpp"
#include "services/ControlThread.hpp"

namespace wr {

/// @brief Control thread that runs in an interrupt of its own. No device uses this interrupt.
/// @function Requests the interrupt in software. The handler of the interrupt then runs the thread
/// at the priority of the interrupt.
/// @secret The method by which the interrupt controller starts a thread, and the other code that
/// this thread may preempt.
class K64Thread final : public ControlThread {
 public:
  /// @param line number of the interrupt line, 0 to 85; no device may use this line
  explicit constexpr K64Thread(std::uint8_t line) : line_(line) {}

  /// @brief Enables an interrupt line.
  /// @param line number of the interrupt line, 0 to 85
  /// @param priority priority of the interrupt, kPulsePriority or a lower priority
  /// @isr{no}
  /// @satisfies FR-172
  static void enable(std::uint8_t line, Priority priority);

  /// @brief Runs one activation of the thread. The handler of the interrupt calls this function.
  /// @isr{yes}
  /// @satisfies FR-172
  void runPended();

 private:
  void pend() override;

  std::uint8_t line_;
};

}  // namespace wr
