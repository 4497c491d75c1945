#pragma once

#include "communication/pc_connection/ConnectionState.hpp"

namespace wr {

/// @brief Connection state while no PC is connected.
/// @function Waits for a Hello.
/// @secret The rule that only a Hello begins a handshake.
/// @role{pc-mcu-connection, Concrete State}
class Disconnected final : public ConnectionState {
 public:
  /// @param handshaking next state after a Hello
  explicit Disconnected(ConnectionState& handshaking);

  /// @brief Requests a Welcome and begins the handshake.
  /// @param connection the connection that received the Hello
  /// @isr{no}
  /// @satisfies FR-30
  void hello(PcConnection& connection) override;

 private:
  ConnectionState& handshaking_;
};

}  // namespace wr
