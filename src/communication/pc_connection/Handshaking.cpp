#include "communication/pc_connection/Handshaking.hpp"

#include "communication/pc_connection/PcConnection.hpp"
#include "services/SystemConstants.hpp"

namespace wr {

Handshaking::Handshaking(ConnectionState& connected, ConnectionState& disconnected)
    : connected_(connected), disconnected_(disconnected) {}

void Handshaking::hello(PcConnection& connection) {
  connection.welcome();
}

bool Handshaking::confirm(PcConnection& connection, std::uint8_t session) {
  if (!connection.offered(session)) {
    connection.countUnexpected();
    return false;
  }
  connection.changeState(connected_);
  return true;
}

void Handshaking::checkTime(PcConnection& connection) {
  if (connection.sinceWelcome() > SystemConstants::instance().handshakeTimeout()) {
    connection.changeState(disconnected_);
  }
}

}  // namespace wr
