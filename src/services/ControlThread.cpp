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
  const std::uint32_t unfinished = activations_.fetch_add(1);
  if (unfinished == 0) {
    pend();
    return true;
  }
  overruns_.fetch_add(1);
  if (unfinished >= 2) {
    activations_.fetch_sub(1);
  }
  return true;
}

std::uint16_t ControlThread::overruns() const {
  constexpr std::uint32_t kMost = std::numeric_limits<std::uint16_t>::max();
  return static_cast<std::uint16_t>(std::min(overruns_.load(), kMost));
}

void ControlThread::run() {
  if (activations_.load() == 0) {
    return;
  }
  body_.load()->execute();
  if (activations_.fetch_sub(1) > 1) {
    pend();
  }
}

}  // namespace wr
