#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "sim/programs/SerialLine.hpp"

namespace wr::programs {

/// @brief A TCP port at 127.0.0.1. One client at a time can connect. Clients can disconnect and
/// connect again.
class TcpLine final : public SerialLine {
 public:
  /// @brief Waits for clients. Throws std::system_error when this fails.
  /// @param port the port; with 0, the system chooses a free port, and name() contains its number
  explicit TcpLine(std::uint16_t port);
  ~TcpLine() override;

  [[nodiscard]] const std::string& name() const override { return name_; }
  std::size_t read(std::span<std::uint8_t> bytes) override;
  bool write(std::span<const std::uint8_t> bytes) override;

 private:
  void leave();

  int door_;
  int client_ = -1;
  std::string name_;
};

}  // namespace wr::programs
