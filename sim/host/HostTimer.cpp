#include "sim/host/HostTimer.hpp"

#include <utility>

#include "sim/host/HostScheduler.hpp"

namespace wr::host {

HostTimer::HostTimer(HostScheduler& scheduler) : scheduler_(scheduler) {}

void HostTimer::connect(std::function<void()> vector) {
  vector_ = std::move(vector);
}

void HostTimer::periodPassed() {
  if (period_ > Microseconds(0) && vector_) {
    pending_ = true;
    scheduler_.interrupt(vector_);
  }
}

Microseconds HostTimer::period() const {
  return period_;
}

bool HostTimer::pending() const {
  return pending_;
}

void HostTimer::start(Microseconds period) {
  period_ = period;
}

void HostTimer::stop() {
  period_ = Microseconds(0);
}

void HostTimer::acknowledge() {
  pending_ = false;
}

}  // namespace wr::host
