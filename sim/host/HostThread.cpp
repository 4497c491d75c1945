#include "sim/host/HostThread.hpp"

#include "sim/host/HostScheduler.hpp"

namespace wr::host {

HostThread::HostThread(HostScheduler& scheduler, int priority)
    : scheduler_(scheduler), priority_(priority) {
  scheduler_.add(*this);
}

bool HostThread::pended() const {
  return pended_;
}

int HostThread::priority() const {
  return priority_;
}

void HostThread::runPended() {
  pended_ = false;
  run();
}

void HostThread::pend() {
  pended_ = true;
  scheduler_.dispatch();
}

}  // namespace wr::host
