#include "sim/programs/TcpLine.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "sim/programs/checked.hpp"

namespace wr::programs {

namespace {

int listenAt(std::uint16_t port) {
  const int door =
      checked(socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0), "socket");
  const int on = 1;
  setsockopt(door, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  if (bind(door, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      listen(door, 1) != 0) {
    const int reason = errno;
    close(door);
    throw std::system_error(reason, std::generic_category(),
                            "cannot open TCP port " + std::to_string(port));
  }
  return door;
}

std::uint16_t portOf(int door) {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  checked(getsockname(door, reinterpret_cast<sockaddr*>(&address), &size), "getsockname");
  return ntohs(address.sin_port);
}

}  // namespace

TcpLine::TcpLine(std::uint16_t port)
    : door_(listenAt(port)), name_("tcp:127.0.0.1:" + std::to_string(portOf(door_))) {}

TcpLine::~TcpLine() {
  leave();
  close(door_);
}

std::size_t TcpLine::read(std::span<std::uint8_t> bytes) {
  if (client_ < 0) {
    client_ = accept4(door_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  }
  const ssize_t count = client_ < 0 ? -1 : recv(client_, bytes.data(), bytes.size(), 0);
  if (count == 0) {
    leave();
  }
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

bool TcpLine::write(std::span<const std::uint8_t> bytes) {
  return client_ >= 0 && send(client_, bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
                             static_cast<ssize_t>(bytes.size());
}

void TcpLine::leave() {
  if (client_ >= 0) {
    close(client_);
    client_ = -1;
  }
}

}  // namespace wr::programs
