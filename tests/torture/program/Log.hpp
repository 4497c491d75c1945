#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "torture/Record.hpp"

namespace wr::torture {

/// @brief The records of the program. The log passes them to the emulator that runs the program.
class Log {
 public:
  /// @brief Adds a record. The handlers of all exceptions can call this function, because
  /// exceptions occur only when the program triggers them.
  void add(const Record& record);

  /// @brief Passes the records to the emulator when many records have been collected. Only thread
  /// mode calls this function.
  void hand();

  /// @brief Passes the last records to the emulator and ends the run.
  void end();

 private:
  static constexpr std::size_t kMost = 12000;

  void flush();

  std::array<Record, kMost> records_;
  std::size_t count_;
  std::uint32_t output_;
  bool full_;
};

}  // namespace wr::torture
