#include "ports/mps2/tests/UnixLine.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace wr::mps2 {

UnixLine::UnixLine(std::string path)
    : path_(std::move(path)), file_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path_.size() >= sizeof(address.sun_path)) {
    throw std::system_error(ENAMETOOLONG, std::generic_category(), path_);
  }
  std::memcpy(address.sun_path, path_.c_str(), path_.size() + 1);
  if (file_ < 0 ||
      ::connect(file_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    const int error = errno;
    ::close(file_);
    throw std::system_error(error, std::generic_category(), path_);
  }
}

UnixLine::~UnixLine() {
  ::close(file_);
}

std::size_t UnixLine::read(std::span<std::uint8_t> bytes) {
  const ssize_t count = ::recv(file_, bytes.data(), bytes.size(), MSG_DONTWAIT);
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

bool UnixLine::write(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::send(file_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count < 0) {
      return false;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(count));
  }
  return true;
}

bool UnixLine::wait(int milliseconds) const {
  pollfd entry{.fd = file_, .events = POLLIN, .revents = 0};
  return ::poll(&entry, 1, milliseconds) > 0;
}

}  // namespace wr::mps2
