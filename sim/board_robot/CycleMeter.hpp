#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <ostream>
#include <vector>

#include "sim/board_robot/BoardSession.hpp"
#include "sim/emulator/ExecutedCode.hpp"

namespace wr::board_robot {

/// @brief A meter of the costs of control cycles. The virtual K64 runs the firmware image that
/// executes these cycles.
///
/// A control cycle lasts from one clock pulse to the next. The clock pulse is the instant at which
/// the timer raises its interrupt line. The report is handed over when the firmware writes the
/// first byte of the report to the serial port. At this instant, the whole report is in the send
/// buffer of the port. The costs of a control cycle include the costs of its interrupts.
class CycleMeter {
 public:
  /// Number of control cycles that are measured.
  static constexpr std::size_t kCycles = 1000;

  /// @brief Costs in processor cycles and instructions.
  struct Cost {
    std::uint64_t cycles = 0;
    std::uint64_t instructions = 0;
  };

  /// @brief Costs of one control cycle.
  struct Cycle {
    Cost toReport;  ///< costs from the clock pulse until the report is handed over
    Cost whole;     ///< costs of the cycle, without the time in which the processor sleeps
    std::uint64_t pulseLatency =
        0;  ///< processor cycles from the clock pulse to the first instruction of its handler
    std::uint64_t startDelay =
        0;  ///< processor cycles from the clock pulse to the first instruction of the main thread
    bool reported = false;  ///< a report was handed over
  };

  /// @brief Costs of one exception in all measured control cycles. Exception 0 is the code outside
  /// of exceptions.
  struct Exception {
    unsigned priority = 0;            ///< 0 to 15; 0 is the highest
    std::uint64_t entries = 0;        ///< number of entries
    Cost whole;                       ///< costs, without the interrupts that preempt the exception
    Cost toReport;                    ///< the part of `whole` between a clock pulse and its report
    std::uint64_t requests = 0;       ///< number of times that a device raised the interrupt line
    std::uint64_t worstLatency = 0;   ///< greatest time from a request to the first instruction of
                                      ///< the handler [processor cycles]
    std::optional<std::uint64_t> at;  ///< processor cycle of the first pending request
  };

  /// @brief Replaces the event callback of the robot, and the callback of the board for writes to
  /// peripherals.
  /// @param robot the robot with its firmware image; it must outlive the meter
  /// @param from start of the measurement; the first measured control cycle begins at the next
  /// clock pulse
  /// @param profiled true to count the executions of each instruction
  CycleMeter(BoardSession& robot, std::chrono::nanoseconds from, bool profiled);
  CycleMeter(const CycleMeter&) = delete;
  CycleMeter& operator=(const CycleMeter&) = delete;

  /// @brief Returns the measurements of the control cycles, at most kCycles.
  [[nodiscard]] const std::vector<Cycle>& cycles() const { return cycles_; }

  /// @brief Returns the measurements of the exceptions that occurred. The key is the number of the
  /// exception.
  [[nodiscard]] std::map<unsigned, Exception> exceptions() const;

  /// @brief Returns the number of executions of an instruction in the measured control cycles.
  /// @param address address of the instruction
  /// @param toReport true for the executions between a clock pulse and its report, false for all
  /// other executions
  [[nodiscard]] std::uint64_t timesOf(std::uint32_t address, bool toReport) const {
    return profile_[toReport ? 1 : 0].timesOf(address);
  }

  /// @brief Returns the greatest depth of the stack. The depth is the distance from the initial
  /// stack pointer to the lowest word that has changed since the meter was constructed.
  /// @return depth [byte]
  [[nodiscard]] std::size_t stackBytes() const;

  /// @brief Writes all measurements as JSON.
  void write(std::ostream& output) const;

 private:
  struct Instant {
    Cost passed;
    std::uint64_t slept = 0;
  };

  void take(const emulator::Event& event);
  void pulse();
  void reported();
  void request(unsigned number);
  void enter(unsigned number);
  void leave();
  void charge();
  [[nodiscard]] Exception& exception(unsigned number);
  void profileTo(bool toReport);
  [[nodiscard]] Instant present() const;
  [[nodiscard]] bool measures() const { return begun_ && cycles_.size() < kCycles; }

  BoardSession& robot_;
  std::chrono::nanoseconds from_;
  bool profiled_;
  bool begun_ = false;
  bool toReport_ = false;  ///< true between a clock pulse and its report
  Instant pulseAt_;
  Instant chargedAt_;  ///< all costs before this instant are assigned to exceptions
  Cycle cycle_;
  std::vector<std::uint32_t> stack_;  ///< words of the stack before the firmware ran
  std::vector<unsigned> active_;
  std::vector<Cycle> cycles_;
  std::vector<Exception> exceptions_;  ///< index: number of the exception
  std::array<emulator::ExecutedCode, 2>
      profile_;  ///< [0]: executions at other times; [1]: between a clock pulse and its report
  emulator::ExecutedCode rest_;  ///< executions after the measured control cycles
};

}  // namespace wr::board_robot
