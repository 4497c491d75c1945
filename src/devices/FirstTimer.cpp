#include "devices/FirstTimer.hpp"

#include "services/SystemConstants.hpp"

namespace wr {

FirstTimer::FirstTimer(PeriodicTimer& timer, Command& command) : timer_(timer), command_(command) {}

void FirstTimer::start() {
  timer_.start(SystemConstants::instance().cyclePeriod());
}

void FirstTimer::expired() {
  timer_.acknowledge();
  command_.execute();
}

}  // namespace wr
