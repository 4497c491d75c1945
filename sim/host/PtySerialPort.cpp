#include "sim/host/PtySerialPort.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

namespace wr {

namespace {

int checked(int result, const char* what) {
  if (result < 0) {
    throw std::system_error(errno, std::generic_category(), what);
  }
  return result;
}

std::string nameOf(int line) {
  const char* name = ptsname(line);
  if (name == nullptr) {
    throw std::system_error(errno, std::generic_category(), "ptsname");
  }
  return name;
}

}  // namespace

PtySerialPort::PtySerialPort() {
  line_ = checked(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC), "posix_openpt");
  checked(grantpt(line_), "grantpt");
  checked(unlockpt(line_), "unlockpt");
  path_ = nameOf(line_);
  farEnd_ = checked(open(path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC), path_.c_str());
  termios settings{};
  checked(tcgetattr(farEnd_, &settings), "tcgetattr");
  cfmakeraw(&settings);
  checked(tcsetattr(farEnd_, TCSANOW, &settings), "tcsetattr");
}

PtySerialPort::~PtySerialPort() {
  close(farEnd_);
  close(line_);
}

const std::string& PtySerialPort::path() const {
  return path_;
}

std::size_t PtySerialPort::read(std::span<std::uint8_t> bytes) {
  send();
  if (received_.empty()) {
    receive();
  }
  const auto places =
      received_.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), received_.size()));
  const auto zero = std::find(received_.begin(), places, 0);
  const auto end = zero == places ? places : zero + 1;
  const auto count = static_cast<std::size_t>(end - received_.begin());
  std::copy(received_.begin(), end, bytes.begin());
  received_.erase(received_.begin(), end);
  return count;
}

void PtySerialPort::receive() {
  received_.resize(kCapacity);
  const ssize_t count = ::read(line_, received_.data(), received_.size());
  received_.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  receivedAt_ = clock_ != nullptr ? clock_->now() : Instant();
}

std::size_t PtySerialPort::free() const {
  return kCapacity - waiting_.size();
}

bool PtySerialPort::write(std::span<const std::uint8_t> bytes) {
  send();
  if (bytes.size() > free()) {
    return false;
  }
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  send();
  return true;
}

std::uint16_t PtySerialPort::lostBytes() const {
  return 0;
}

void PtySerialPort::send() {
  const ssize_t count = ::write(line_, waiting_.data(), waiting_.size());
  if (count > 0) {
    waiting_.erase(waiting_.begin(), waiting_.begin() + count);
  }
}

}  // namespace wr
