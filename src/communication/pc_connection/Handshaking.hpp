#pragma once

#include "communication/pc_connection/ConnectionState.hpp"

namespace wr {

/// @brief Connection state after a Hello, while a correct Confirm is still missing.
/// @function Waits until the PC confirms the session that the Welcome offered.
/// @secret The condition that a Confirm must meet, and the time within which it must arrive.
/// @role{pc-mcu-connection, Concrete State}
class Handshaking final : public ConnectionState {
 public:
  /// @param connected next state after a correct Confirm
  /// @param disconnected next state when no correct Confirm arrives in time
  Handshaking(ConnectionState& connected, ConnectionState& disconnected);

  /// @brief Requests a Welcome with a new session. The handshake begins again.
  /// @param connection the connection that received the Hello
  /// @isr{no}
  /// @satisfies FR-30
  void hello(PcConnection& connection) override;

  /// @brief Connects the PC if the Confirm contains the session of the newest Welcome. Otherwise
  /// drops the Confirm and counts it as unexpected.
  /// @param connection the connection that received the Confirm
  /// @param session number of the session that the PC accepts
  /// @return false when the frame was dropped
  /// @isr{no}
  /// @satisfies FR-31
  /// @satisfies FR-47
  bool confirm(PcConnection& connection, std::uint8_t session) override;

  /// @brief Ends the handshake if the newest Welcome is more than 1 s old.
  /// @param connection the connection whose time limits are checked
  /// @isr{no}
  /// @satisfies FR-32
  void checkTime(PcConnection& connection) override;

 private:
  ConnectionState& connected_;
  ConnectionState& disconnected_;
};

}  // namespace wr
