#include "communication/pc_connection/Connected.hpp"

#include "communication/pc_connection/PcConnection.hpp"
#include "services/SystemConstants.hpp"

namespace wr {

Connected::Connected(ConnectionState& handshaking, ConnectionState& disconnected)
    : handshaking_(handshaking), disconnected_(disconnected) {}

void Connected::hello(PcConnection& connection) {
  connection.dropOrder();
  connection.welcome();
  connection.changeState(handshaking_);
}

bool Connected::keepAlive(PcConnection& /*connection*/) {
  return true;
}

bool Connected::order(PcConnection& connection, const Frame& frame) {
  return connection.takeOrder(frame);
}

void Connected::checkTime(PcConnection& connection) {
  if (connection.silence() >= SystemConstants::instance().linkTimeout()) {
    connection.dropOrder();
    connection.changeState(disconnected_);
  }
}

bool Connected::connected() const {
  return true;
}

}  // namespace wr
