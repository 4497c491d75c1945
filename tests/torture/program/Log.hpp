#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "torture/Record.hpp"

namespace wr::torture {

/// @brief The records of the program, which are passed to the machine that runs it.
class Log {
 public:
  /// @brief Adds a record. Each exception can call it, because exceptions only come when the
  /// program triggers them.
  void add(const Record& record);

  /// @brief Passes the records to the machine when many have been collected. Only thread mode calls
  /// it.
  void hand();

  /// @brief Passes the last records to the machine and ends the run.
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
