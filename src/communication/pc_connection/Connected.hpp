#pragma once

#include "communication/pc_connection/ConnectionState.hpp"

namespace wr {

/// @brief Connection state while the PC is connected.
/// @function Accepts orders. Ends the connection when the PC is silent for too long or sends a new
/// Hello.
/// @secret The events that keep the PC connected, and the data that are dropped when the connection
/// ends.
/// @role{pc-mcu-connection, Concrete State}
class Connected final : public ConnectionState {
 public:
  /// @param handshaking next state after a Hello
  /// @param disconnected next state when the PC was silent for too long
  Connected(ConnectionState& handshaking, ConnectionState& disconnected);

  /// @brief Ends the connection, drops the newest order, requests a Welcome and begins a new
  /// handshake.
  /// @param connection the connection that received the Hello
  /// @isr{no}
  /// @satisfies FR-30
  /// @satisfies FR-34
  void hello(PcConnection& connection) override;

  /// @brief Accepts a KeepAlive, by which the PC shows that it is still connected.
  /// @param connection the connection that received the KeepAlive
  /// @return true
  /// @isr{no}
  /// @satisfies FR-33
  bool keepAlive(PcConnection& connection) override;

  /// @brief Stores the order as the newest order.
  /// @param connection the connection that received the order
  /// @param frame frame that contains the order
  /// @return false when the order was dropped because it is stale or has a field out of range
  /// @isr{no}
  /// @satisfies FR-36
  bool order(PcConnection& connection, const Frame& frame) override;

  /// @brief Ends the connection and drops the newest order if the PC has been silent for
  /// linkTimeout() or longer.
  /// @param connection the connection whose time limits are checked
  /// @isr{no}
  /// @satisfies FR-33
  void checkTime(PcConnection& connection) override;

  /// @brief Returns true: the PC is connected.
  /// @return true
  /// @isr{no}
  /// @satisfies FR-36
  [[nodiscard]] bool connected() const override;

 private:
  ConnectionState& handshaking_;
  ConnectionState& disconnected_;
};

}  // namespace wr
