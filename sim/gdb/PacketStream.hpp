#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "sim/programs/SerialLine.hpp"

namespace wr::gdb {

/// @brief The packets of the GDB remote serial protocol on a serial line. A packet has the form
/// `$content#checksum`, and is acknowledged. See the manual of GDB, appendix Remote Protocol.
class PacketStream {
 public:
  /// @brief Constructs the stream. Packets are acknowledged at first.
  /// @param line the serial line to GDB; must outlive the object
  explicit PacketStream(programs::SerialLine& line) : line_(line) {}

  /// @brief Returns the content of the next packet. Returns nothing while no packet is complete.
  [[nodiscard]] std::optional<std::string> take();

  /// @brief Reads the serial line. Returns true if Ctrl-C was received since the last call.
  [[nodiscard]] bool takeInterrupt();

  /// @brief Reads the serial line. Returns true if a part of a packet was received.
  [[nodiscard]] bool waiting();

  /// @brief Sends a packet.
  /// @param content without `$`, `#`, `}` and `*`
  void send(std::string_view content);

  /// @brief Stops the acknowledgements. The caller must first agree on this with GDB.
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
