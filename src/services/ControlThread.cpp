#include "services/ControlThread.hpp"

#include <algorithm>
#include <limits>

#include "services/assertion.hpp"

namespace wr {

void ControlThread::start(Command& body) {
  require(body_.load() == nullptr, AssertId::ThreadStartedTwice);
  body_.store(&body);
}

bool ControlThread::post() {
  if (body_.load() == nullptr) {
    return false;
  }
  const std::uint32_t before = state_.fetch_or(kWaiting);
  if (before == kIdle) {
    pend();
  } else {
    overruns_.fetch_add(1);
  }
  return true;
}

std::uint16_t ControlThread::overruns() const {
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint16_t>::max();
  return static_cast<std::uint16_t>(std::min(overruns_.load(), kMost));
}

void ControlThread::run() {
  if ((state_.load() & kWaiting) == 0) {
    return;
  }
  state_.fetch_xor(kWaiting | kRunning);
  body_.load()->execute();
  if ((state_.fetch_and(~kRunning) & kWaiting) != 0) {
    pend();
  }
}

}  // namespace wr
