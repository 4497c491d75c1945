#include "communication/pc_connection/Disconnected.hpp"

#include "communication/pc_connection/PcConnection.hpp"

namespace wr {

Disconnected::Disconnected(ConnectionState& handshaking) : handshaking_(handshaking) {}

void Disconnected::hello(PcConnection& connection) {
  connection.welcome();
  connection.changeState(handshaking_);
}

}  // namespace wr
