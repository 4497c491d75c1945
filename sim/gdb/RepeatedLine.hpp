#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "sim/programs/SerialLine.hpp"

namespace wr::gdb {

/// @brief A serial line whose input can be repeated. A restarted run reads the same bytes at the
/// same calls of read(). If it repeats output, this output is discarded.
class RepeatedLine final : public programs::SerialLine {
 public:
  /// @param line the serial line
  explicit RepeatedLine(std::unique_ptr<programs::SerialLine> line) : line_(std::move(line)) {}

  /// @brief Restarts the run.
  void beginAgain() { next_ = 0; }

  [[nodiscard]] const std::string& name() const override { return line_->name(); }
  std::size_t read(std::span<std::uint8_t> bytes) override;
  bool write(std::span<const std::uint8_t> bytes) override;

 private:
  std::unique_ptr<programs::SerialLine> line_;
  std::vector<std::vector<std::uint8_t>> reads_;
  std::size_t next_ = 0;
};

}  // namespace wr::gdb
