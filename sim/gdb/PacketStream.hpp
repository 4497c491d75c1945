#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/programs/SerialLine.hpp"

namespace wr::gdb {

/// @brief The packets of the GDB remote serial protocol on a line: `$content#checksum`, with
/// acknowledgements. See the manual of GDB, appendix Remote Protocol.
class PacketStream {
 public:
  /// @brief Constructs the stream, with acknowledgements.
  /// @param line the line to GDB; must outlive the object
  explicit PacketStream(programs::SerialLine& line) : line_(line) {}

  /// @brief Returns the content of the next packet; nothing while no packet is complete.
  [[nodiscard]] std::optional<std::string> take();

  /// @brief Returns whether Ctrl-C came since the last call. Reads the line.
  [[nodiscard]] bool takeInterrupt();

  /// @brief Returns whether a part of a packet was received. Reads the line.
  [[nodiscard]] bool waiting();

  /// @brief Sends a packet.
  /// @param content without `$`, `#`, `}` and `*`
  void send(std::string_view content);

  /// @brief Ends the acknowledgements, after both sides have agreed.
  void stopAcknowledging() { acknowledges_ = false; }

 private:
  void fill();
  [[nodiscard]] std::optional<std::string> cut();
  void write(std::string_view bytes);

  programs::SerialLine& line_;
  std::string received_;
  std::string last_;
  bool acknowledges_ = true;
  bool interrupted_ = false;
};

}  // namespace wr::gdb
