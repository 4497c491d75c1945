#include "wheel_control/orders/ReadCurrent.hpp"

namespace wr {

ReadCurrent::ReadCurrent(CntSensor& sensor, WheelController& controller)
    : sensor_(sensor), controller_(controller) {}

void ReadCurrent::execute(WheelWork& work) {
  sensor_.measure();
  work.measured.current = controller_.current(work.at);
}

}  // namespace wr
