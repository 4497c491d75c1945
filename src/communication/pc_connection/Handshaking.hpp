#pragma once

#include "communication/pc_connection/ConnectionState.hpp"

namespace wr {

/// @brief A Hello was received, and the Confirm of its Welcome has not come.
/// @function Waits for the Confirm of the session that the Welcome offered.
/// @secret The condition for a correct Confirm, and the time limit for it.
/// @role{pc-mcu-connection, Concrete State}
class Handshaking final : public ConnectionState {
 public:
  /// @brief Constructs the state.
  /// @param connected state that follows a correct Confirm
  /// @param disconnected state that follows when no correct Confirm comes
  Handshaking(ConnectionState& connected, ConnectionState& disconnected);

  /// @brief Requests a Welcome with a new session. The handshake begins again.
  /// @param connection the connection that received the Hello
  /// @isr{no}
  /// @satisfies FR-30
  void hello(PcConnection& connection) override;

  /// @brief Connects the PC when it accepts the session of the newest Welcome.
  /// @param connection the connection that received the Confirm
  /// @param session number of the session that the PC accepts
  /// @return false when the frame was dropped
  /// @isr{no}
  /// @satisfies FR-31
  /// @satisfies FR-47
  bool confirm(PcConnection& connection, std::uint8_t session) override;

  /// @brief Ends the handshake when the Welcome is more than 1 s old.
  /// @param connection the connection whose time is checked
  /// @isr{no}
  /// @satisfies FR-32
  void checkTime(PcConnection& connection) override;

 private:
  ConnectionState& connected_;
  ConnectionState& disconnected_;
};

}  // namespace wr
