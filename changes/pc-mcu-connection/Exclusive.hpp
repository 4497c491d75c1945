#pragma once

#include "communication/pc_connection/ConnectionState.hpp"
#include "communication/pc_connection/PcConnection.hpp"
#include "services/SystemConstants.hpp"

namespace wr {

/// @brief The PC is connected, and no other PC can take its place: a Hello is not answered.
class Exclusive final : public ConnectionState {
 public:
  /// @brief Binds the state to its successor.
  /// @param disconnected state after a silence; only its address is used before the first frame
  explicit Exclusive(ConnectionState& disconnected) : disconnected_(disconnected) {}

  /// @brief Counts the Hello as unexpected, and answers nothing.
  /// @param connection the connection that received it
  /// @isr{no}
  void hello(PcConnection& connection) override { connection.countUnexpected(); }

  /// @brief Accepts a sign of life.
  /// @return true
  /// @isr{no}
  bool keepAlive(PcConnection& /*connection*/) override { return true; }

  /// @brief Stores an order.
  /// @param connection the connection that received it
  /// @param frame the frame of the order
  /// @return false when the frame was dropped
  /// @isr{no}
  bool order(PcConnection& connection, const Frame& frame) override {
    return connection.takeOrder(frame);
  }

  /// @brief Ends the session after a silence.
  /// @param connection the connection whose time is checked
  /// @isr{no}
  void checkTime(PcConnection& connection) override {
    if (connection.silence() >= SystemConstants::instance().linkTimeout()) {
      connection.dropOrder();
      connection.changeState(disconnected_);
    }
  }

  /// @brief Returns true: the PC is connected.
  /// @return true
  /// @isr{no}
  [[nodiscard]] bool connected() const override { return true; }

 private:
  ConnectionState& disconnected_;
};

}  // namespace wr
