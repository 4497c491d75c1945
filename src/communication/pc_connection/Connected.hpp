#pragma once

#include "communication/pc_connection/ConnectionState.hpp"

namespace wr {

/// @brief The PC is connected.
/// @function Accepts orders, and ends the connection when the PC is silent or sends Hello again.
/// @secret The events that keep a connection, and the data that are dropped at its end.
/// @role{pc-mcu-connection, Concrete State}
class Connected final : public ConnectionState {
 public:
  /// @brief Constructs the state.
  /// @param handshaking state that follows a Hello
  /// @param disconnected state that follows when the PC is silent
  Connected(ConnectionState& handshaking, ConnectionState& disconnected);

  /// @brief Ends the connection, drops the newest order, requests a Welcome and begins a new
  /// handshake.
  /// @param connection the connection that received the Hello
  /// @isr{no}
  /// @satisfies FR-30
  /// @satisfies FR-34
  void hello(PcConnection& connection) override;

  /// @brief Accepts the sign of life of the PC.
  /// @param connection the connection that received the KeepAlive
  /// @return true
  /// @isr{no}
  /// @satisfies FR-33
  bool keepAlive(PcConnection& connection) override;

  /// @brief Stores the order as the newest order.
  /// @param connection the connection that received it
  /// @param frame the frame of the order
  /// @return false when the order was dropped: it is stale, or a field is out of range
  /// @isr{no}
  /// @satisfies FR-36
  bool order(PcConnection& connection, const Frame& frame) override;

  /// @brief Ends the connection and drops the newest order when the PC was silent for too long.
  /// @param connection the connection whose time is checked
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
