#include "sim/scenario/ControlChannel.hpp"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <exception>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

#include "sim/scenario/Scenario.hpp"
#include "sim/scenario/ScenarioPlayer.hpp"

namespace wr::scenario {

namespace {

constexpr std::size_t kLongest = 512;

// Actions of the PC are rejected, because the PC link is in use. The other actions of this list
// need a scenario.
constexpr auto kRefused = std::to_array<std::string_view>(
    {"connect", "arm", "hello", "confirm", "keepalive", "order", "replay", "bytes", "mark",
     "expect-silence", "expect-finding"});

bool isRefused(const std::string& words) {
  std::string first;
  std::istringstream(words) >> first;
  return std::ranges::find(kRefused, first) != kRefused.end();
}

sockaddr_un addressOf(const std::filesystem::path& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string& text = path.native();
  if (text.size() >= sizeof address.sun_path) {
    throw std::invalid_argument("the path of the control socket is too long: " + text);
  }
  std::memcpy(static_cast<void*>(address.sun_path), text.data(), text.size());
  return address;
}

}  // namespace

ControlChannel::ControlChannel(std::filesystem::path path, RobotSession& robot)
    : path_(std::move(path)), robot_(robot) {
  if (path_.empty()) {
    return;
  }
  const sockaddr_un address = addressOf(path_);
  if (std::filesystem::is_socket(path_)) {
    std::filesystem::remove(path_);
  }
  socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket_ < 0 ||
      bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    const int reason = errno;
    if (socket_ >= 0) {
      close(socket_);
    }
    throw std::system_error(reason, std::generic_category(),
                            "cannot open the control socket " + path_.string());
  }
}

ControlChannel::~ControlChannel() {
  if (socket_ >= 0) {
    close(socket_);
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
}

void ControlChannel::serve() {
  if (socket_ < 0) {
    return;
  }
  std::array<char, kLongest> words{};
  for (;;) {
    sockaddr_un sender{};
    socklen_t size = sizeof sender;
    const ssize_t count = recvfrom(socket_, words.data(), words.size(), 0,
                                   reinterpret_cast<sockaddr*>(&sender), &size);
    if (count < 0) {
      return;
    }
    const std::string answer = perform(std::string(words.data(), static_cast<std::size_t>(count)));
    if (size > sizeof(sa_family_t)) {  // without a name of its socket, a sender gets no answer
      static_cast<void>(sendto(socket_, answer.data(), answer.size(), 0,
                               reinterpret_cast<const sockaddr*>(&sender), size));
    }
  }
}

std::string ControlChannel::perform(const std::string& words) {
  try {
    if (words.find('\n') != std::string::npos) {
      return "an action must have exactly one line";
    }
    if (isRefused(words)) {
      return "'" + words + "' is only possible in a scenario";
    }
    std::istringstream text("at 0 " + words + "\nat 0 end\n");
    const Scenario scenario(text, "control");
    const ScenarioPlayer::Outcome outcome = ScenarioPlayer(scenario, robot_).play();
    return outcome.failures.empty() ? "ok" : outcome.failures.front();
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace wr::scenario
