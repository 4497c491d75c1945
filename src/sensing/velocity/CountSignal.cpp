#include "sensing/velocity/CountSignal.hpp"

namespace wr {

CountSignal::CountSignal(SensorCollector& collector, const ActiveSensor& sensor,
                         const Timebase& timebase)
    : collector_(collector), sensor_(sensor), timebase_(timebase) {}

void CountSignal::execute() {
  collector_.collect(sensor_.phase(), timebase_.now());
}

}  // namespace wr
