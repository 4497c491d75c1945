#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim/programs/SerialLine.hpp"

namespace wr::programs {

/// @brief A pseudo-terminal on this computer.
///
/// Clients use the far end of the pseudo-terminal. The object also keeps the far end open.
/// Therefore clients can disconnect and connect again. If the pseudo-terminal cannot accept bytes
/// immediately, these bytes wait in a bounded buffer.
class PseudoTerminal final : public SerialLine {
 public:
  /// @brief Maximum number of bytes that wait to be sent.
  static constexpr std::size_t kCapacity = 512;

  /// @brief Opens a pseudo-terminal in raw mode. Throws std::system_error when this fails.
  PseudoTerminal();
  ~PseudoTerminal() override;

  [[nodiscard]] const std::string& name() const override { return path_; }
  std::size_t read(std::span<std::uint8_t> bytes) override;
  bool write(std::span<const std::uint8_t> bytes) override;

 private:
  void send();

  int line_ = -1;
  int farEnd_ = -1;
  std::string path_;
  std::vector<std::uint8_t> waiting_;
};

}  // namespace wr::programs
