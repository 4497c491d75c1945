#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <ostream>

#include "sim/board_robot/BoardSession.hpp"
#include "sim/emulator/CallRecorder.hpp"

namespace wr::board_robot {

/// @brief A writer that lists the calls and events of a part of a run, each with its time.
///
/// Each line of the output has the time in ns, the name of the event, a number and a value. For a
/// call or a return, the number is the address of the function. For the entry of an interrupt, the
/// value is the priority of the interrupt.
class CallTimeline {
 public:
  /// @brief A part of a run. Both limits are times since the board was switched on.
  struct Window {
    std::chrono::nanoseconds from;
    std::chrono::nanoseconds to;
  };

  /// @brief Replaces the event callback of the robot. The timeline must be constructed before the
  /// first run.
  /// @param robot the robot with its firmware image; it must outlive the timeline
  /// @param elf ELF file of the firmware image, with its symbols
  /// @param window the recorded part of the run
  /// @param output receives the output; it must outlive the timeline
  CallTimeline(BoardSession& robot, const std::filesystem::path& elf, Window window,
               std::ostream& output);
  CallTimeline(const CallTimeline&) = delete;
  CallTimeline& operator=(const CallTimeline&) = delete;

 private:
  void take(const emulator::Event& event);
  void write(const char* event, std::uint32_t number, std::uint32_t value);

  BoardSession& robot_;
  emulator::CallRecorder recorder_;
  Window window_;
  std::ostream& output_;
};

}  // namespace wr::board_robot
