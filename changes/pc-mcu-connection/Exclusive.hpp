#pragma once

#include "communication/pc_connection/ConnectionState.hpp"
#include "communication/pc_connection/PcConnection.hpp"
#include "services/SystemConstants.hpp"

namespace wr {

/// @brief The state of the connection while a PC is connected. No other PC can connect, because a
/// Hello is not answered.
class Exclusive final : public ConnectionState {
 public:
  /// @param disconnected state that follows when the PC is silent for too long; it need not be
  /// constructed before the first frame
  explicit Exclusive(ConnectionState& disconnected) : disconnected_(disconnected) {}

  /// @brief Counts the Hello as unexpected, and sends no answer.
  /// @param connection connection that received the Hello
  /// @isr{no}
  void hello(PcConnection& connection) override { connection.countUnexpected(); }

  /// @brief Accepts a KeepAlive.
  /// @return true
  /// @isr{no}
  bool keepAlive(PcConnection& /*connection*/) override { return true; }

  /// @brief Stores a received order.
  /// @param connection connection that received the order
  /// @param frame frame that contains the order
  /// @return false if the frame was dropped
  /// @isr{no}
  bool order(PcConnection& connection, const Frame& frame) override {
    return connection.takeOrder(frame);
  }

  /// @brief Ends the session if the PC is silent for too long.
  /// @param connection connection whose time is checked
  /// @isr{no}
  void checkTime(PcConnection& connection) override {
    if (connection.silence() >= SystemConstants::instance().linkTimeout()) {
      connection.dropOrder();
      connection.changeState(disconnected_);
    }
  }

  /// @brief Returns true, because the PC is connected in this state.
  /// @return true
  /// @isr{no}
  [[nodiscard]] bool connected() const override { return true; }

 private:
  ConnectionState& disconnected_;
};

}  // namespace wr
