#include "sim/host/HostScheduler.hpp"

#include <utility>

#include "sim/host/HostThread.hpp"

namespace wr::host {

void HostScheduler::add(HostThread& thread) {
  threads_.push_back(&thread);
}

void HostScheduler::beforeThread(std::function<void(const HostThread& thread)> call) {
  beforeThread_ = std::move(call);
}

void HostScheduler::dispatch() {
  if (interrupts_ > 0) {
    return;
  }
  for (HostThread* thread = next(); thread != nullptr; thread = next()) {
    const int interrupted = std::exchange(runningPriority_, thread->priority());
    if (beforeThread_) {
      beforeThread_(*thread);
    }
    thread->runPended();
    runningPriority_ = interrupted;
  }
}

void HostScheduler::interrupt(const std::function<void()>& vector) {
  ++interrupts_;
  vector();
  --interrupts_;
  dispatch();
}

HostThread* HostScheduler::next() const {
  HostThread* best = nullptr;
  int priority = runningPriority_;
  for (HostThread* thread : threads_) {
    if (thread->pended() && thread->priority() > priority) {
      best = thread;
      priority = thread->priority();
    }
  }
  return best;
}

}  // namespace wr::host
