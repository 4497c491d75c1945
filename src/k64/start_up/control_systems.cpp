#include "k64/start_up/control_systems.hpp"

#include <array>
#include <cstddef>

#include "construction/ControlSystemBuilder.hpp"
#include "construction/DirSystemBuilder.hpp"
#include "construction/WheelSystemBuilder.hpp"
#include "k64/core.hpp"
#include "k64/start_up/handlers.hpp"
#include "k64/start_up/platform.hpp"

namespace wr::platform {

namespace {

WheelSystemBuilder::Devices devicesOf(std::size_t wheel) {
  WheelDevices& devices = wheels[wheel];
  return {.pwm = devices.pwm,
          .orientation = devices.orientation,
          .enable = devices.enable,
          .hallA = devices.hallA,
          .hallB = devices.hallB,
          .current = devices.current,
          .thread = devices.thread,
          .timebase = timebase,
          .wheel = wheel};
}

DirSystemBuilder steeringBuilder({.step = steeringStep,
                                  .direction = steeringDirection,
                                  .enable = steeringEnable,
                                  .leftEnd = leftEnd,
                                  .rightEnd = rightEnd,
                                  .angle = steeringAngle,
                                  .timebase = timebase});

}  // namespace

std::array<WheelSystemBuilder, kWheelCount> wheelBuilders{
    WheelSystemBuilder(devicesOf(0)), WheelSystemBuilder(devicesOf(1)),
    WheelSystemBuilder(devicesOf(2)), WheelSystemBuilder(devicesOf(3))};
constinit const std::array<ControlSystemBuilder*, kWheelCount + 1> systemBuilders{
    &wheelBuilders[0], &wheelBuilders[1], &wheelBuilders[2], &wheelBuilders[3], &steeringBuilder};

}  // namespace wr::platform

// Each handler ends with finishStores(). src/k64/start_up/platform.cpp states the reason.

void hallSensorInterrupt() {
  // bound: kWheelCount
  for (wr::WheelSystemBuilder& builder : wr::platform::wheelBuilders) {
    builder.sensor().serve();
  }
  wr::finishStores();
}
