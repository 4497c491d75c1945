#include "communication/pc_connection/ConnectionState.hpp"

#include "communication/pc_connection/PcConnection.hpp"

namespace wr {

bool ConnectionState::confirm(PcConnection& connection, std::uint8_t /*session*/) {
  connection.countUnexpected();
  return false;
}

bool ConnectionState::keepAlive(PcConnection& connection) {
  connection.countUnexpected();
  return false;
}

bool ConnectionState::order(PcConnection& connection, const Frame& /*frame*/) {
  connection.countUnexpected();
  return false;
}

void ConnectionState::checkTime(PcConnection& /*connection*/) {}

bool ConnectionState::connected() const {
  return false;
}

}  // namespace wr
