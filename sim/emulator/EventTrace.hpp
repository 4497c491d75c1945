#pragma once

#include <cstdint>
#include <ostream>

#include "sim/emulator/VirtualBoard.hpp"

namespace wr::emulator {

/// @brief Returns the name of a kind of event in the files.
[[nodiscard]] const char* nameOf(Event::Kind kind);

/// @brief What happened on a virtual board: a number for the whole of it, and a line for each event.
class EventTrace {
 public:
  /// @brief Begins a trace.
  /// @param lines gets the events as comma-separated values; null: only the hash is made
  explicit EventTrace(std::ostream* lines = nullptr);

  /// @brief Adds an event.
  /// @param event what happened
  void add(const emulator::Event& event);

  /// @brief Number of events.
  /// @return the number
  [[nodiscard]] std::uint64_t events() const { return events_; }

  /// @brief FNV-1a of all events: two runs that differ in anything have different ones.
  /// @return the hash
  [[nodiscard]] std::uint64_t hash() const { return hash_; }

 private:
  void mix(std::uint64_t value);

  std::ostream* lines_;
  std::uint64_t events_ = 0;
  std::uint64_t hash_ = 0xCBF29CE484222325U;
};

}  // namespace wr::emulator
