#include "sim/programs/PseudoTerminal.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <array>

#include "sim/programs/checked.hpp"

namespace wr::programs {

namespace {

std::string nameOf(int line) {
  std::array<char, 64> name{};
  checked(ptsname_r(line, name.data(), name.size()) == 0 ? 0 : -1, "ptsname_r");
  return name.data();
}

}  // namespace

PseudoTerminal::PseudoTerminal() {
  line_ = checked(posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC), "posix_openpt");
  checked(grantpt(line_), "grantpt");
  checked(unlockpt(line_), "unlockpt");
  path_ = nameOf(line_);
  farEnd_ = checked(open(path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC), path_);
  termios settings{};
  checked(tcgetattr(farEnd_, &settings), "tcgetattr");
  cfmakeraw(&settings);
  checked(tcsetattr(farEnd_, TCSANOW, &settings), "tcsetattr");
}

PseudoTerminal::~PseudoTerminal() {
  close(farEnd_);
  close(line_);
}

std::size_t PseudoTerminal::read(std::span<std::uint8_t> bytes) {
  send();
  const ssize_t count = ::read(line_, bytes.data(), bytes.size());
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

bool PseudoTerminal::write(std::span<const std::uint8_t> bytes) {
  send();
  if (bytes.size() > kCapacity - waiting_.size()) {
    return false;
  }
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  send();
  return true;
}

void PseudoTerminal::send() {
  const ssize_t count = ::write(line_, waiting_.data(), waiting_.size());
  if (count > 0) {
    waiting_.erase(waiting_.begin(), waiting_.begin() + count);
  }
}

}  // namespace wr::programs
