#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "sim/programs/SerialLine.hpp"

namespace wr::mps2 {

/// @brief A connection to a program that listens at a Unix socket.
class UnixLine final : public programs::SerialLine {
 public:
  /// @brief Connects to the socket. Throws std::system_error if no program listens at the socket.
  /// @param path path of the socket
  explicit UnixLine(std::string path);
  ~UnixLine() override;

  [[nodiscard]] const std::string& name() const override { return path_; }
  std::size_t read(std::span<std::uint8_t> bytes) override;
  bool write(std::span<const std::uint8_t> bytes) override;

  /// @brief Waits until bytes can be read.
  /// @param milliseconds longest time to wait [ms]
  /// @return false if no bytes arrived in this time
  [[nodiscard]] bool wait(int milliseconds) const;

 private:
  std::string path_;
  int file_;
};

}  // namespace wr::mps2
