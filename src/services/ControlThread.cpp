#include "services/ControlThread.hpp"

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
  if (accepted_.load() - ended_.load() > 1) {
    overruns_.fetch_add(1);
    return true;
  }
  const std::uint32_t before = accepted_.fetch_add(1);
  if (before == ended_.load()) {
    pend();
  } else {
    overruns_.fetch_add(1);
  }
  return true;
}

std::uint32_t ControlThread::overruns() const {
  return overruns_.load();
}

void ControlThread::run() {
  if (accepted_.load() == ended_.load()) {
    return;
  }
  body_.load()->execute();
  const std::uint32_t ended = ended_.fetch_add(1) + 1;
  if (accepted_.load() != ended) {
    pend();
  }
}

}  // namespace wr
