#include "devices/SecondTimer.hpp"

#include <span>

#include "services/SystemConstants.hpp"
#include "services/assertion.hpp"

namespace wr {

SecondTimer::SecondTimer(PeriodicTimer& timer) : timer_(timer) {}

void SecondTimer::add(Command& command) {
  require(count_ < kCapacity, AssertId::TimerFull);
  commands_[count_] = &command;
  ++count_;
}

void SecondTimer::start() {
  timer_.start(SystemConstants::instance().tickPeriod());
}

void SecondTimer::expired() {
  timer_.acknowledge();
  // bound: tickCommands
  for (Command* const command : std::span(commands_).first(count_)) {
    command->execute();
  }
}

}  // namespace wr
