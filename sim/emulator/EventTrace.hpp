#pragma once

#include <cstdint>
#include <ostream>

#include "sim/emulator/VirtualBoard.hpp"

namespace wr::emulator {

/// @brief Returns the name of a kind of event, as in the trace files.
[[nodiscard]] const char* nameOf(Event::Kind kind);

/// @brief A trace of the events of a virtual board, with one line of text for each event and a hash
/// of all events.
class EventTrace {
 public:
  /// @brief Writes the names of the columns.
  /// @param lines receives the events as comma-separated values; if it is null, only the hash is
  /// computed
  explicit EventTrace(std::ostream* lines = nullptr);

  /// @brief Adds an event.
  void add(const emulator::Event& event);

  /// @brief Returns the number of events.
  [[nodiscard]] std::uint64_t events() const { return events_; }

  /// @brief Returns the FNV-1a hash of all events. Runs with different events almost certainly have
  /// different hashes.
  [[nodiscard]] std::uint64_t hash() const { return hash_; }

 private:
  void mix(std::uint64_t value);

  std::ostream* lines_;
  std::uint64_t events_ = 0;
  std::uint64_t hash_ = 0xCBF29CE484222325U;
};

}  // namespace wr::emulator
