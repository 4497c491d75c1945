#include "sim/host/HostWatchdog.hpp"

#include "services/SystemConstants.hpp"

namespace wr::host {

HostWatchdog::HostWatchdog(const Timebase& timebase) : timebase_(timebase), last_(timebase.now()) {}

std::uint32_t HostWatchdog::refreshes() const {
  return refreshes_;
}

bool HostWatchdog::missed() const {
  return missed_ || timebase_.now() - last_ >= SystemConstants::instance().watchdogTimeout();
}

void HostWatchdog::refresh() {
  missed_ = missed();
  last_ = timebase_.now();
  ++refreshes_;
}

}  // namespace wr::host
