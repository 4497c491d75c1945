#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "sim/programs/SerialLine.hpp"

namespace wr::mps2 {

/// @brief A line to a program that listens at a socket of this machine.
class UnixLine final : public programs::SerialLine {
 public:
  /// @brief Connects. Throws std::system_error when no program listens.
  /// @param path the socket
  explicit UnixLine(std::string path);
  ~UnixLine() override;

  [[nodiscard]] const std::string& name() const override { return path_; }
  std::size_t read(std::span<std::uint8_t> bytes) override;
  bool write(std::span<const std::uint8_t> bytes) override;

  /// @brief Waits until bytes can be read.
  /// @param milliseconds the longest time
  /// @return false if no bytes came
  [[nodiscard]] bool wait(int milliseconds) const;

 private:
  std::string path_;
  int file_;
};

}  // namespace wr::mps2
