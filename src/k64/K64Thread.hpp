#pragma once

#include <cstdint>

#include "k64/core.hpp"
#include "services/ControlThread.hpp"

namespace wr {

/// @brief A control thread on an interrupt line that no device uses.
/// @function Lets the interrupt controller run the body at the priority of the thread.
/// @secret How the interrupt controller runs a body, and when it may preempt others.
class K64Thread final : public ControlThread {
 public:
  /// @brief Binds a thread to an interrupt line.
  /// @param line number of the line, 0 to 85; no device uses it
  explicit constexpr K64Thread(std::uint8_t line) : line_(line) {}

  /// @brief Enables an interrupt line.
  /// @param line number of the line, 0 to 85
  /// @param priority its priority, not above the priority of the edges
  /// @isr{no}
  /// @satisfies FR-172
  static void enable(std::uint8_t line, Priority priority);

  /// @brief Runs one activation. The vector of the line calls this function.
  /// @isr{yes}
  /// @satisfies FR-172
  void runPended();

 private:
  void pend() override;

  std::uint8_t line_;
};

}  // namespace wr
