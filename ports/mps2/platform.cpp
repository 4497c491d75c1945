#include "k64/start_up/platform.hpp"

#include <cstdint>

#include "k64/core.hpp"
#include "k64/start_up/handlers.hpp"
#include "ports/mps2/lines.hpp"
#include "ports/mps2/registers.hpp"
#include "ports/mps2/rest.hpp"

namespace wr::platform {

namespace {

constinit mps2::FpgaLight runningLight(mps2::lights::LED_RUNNING);

}  // namespace

constinit mps2::CmsdkWatchdog watchdog;
constinit mps2::CmsdkTimebase timebase;
constinit mps2::CmsdkTimer cycleTimer(mps2::CmsdkTimer::Number::First);
constinit mps2::CmsdkTimer tickTimer(mps2::CmsdkTimer::Number::Second);
mps2::CmsdkUart pcPort(timebase);
constinit K64Thread mainThread(mps2::kMainThreadLine);
constinit std::array<WheelDevices, kWheelCount> wheels{
    WheelDevices{.thread = K64Thread(mps2::kFirstWheelThreadLine)},
    WheelDevices{.thread = K64Thread(mps2::kFirstWheelThreadLine + 1)},
    WheelDevices{.thread = K64Thread(mps2::kFirstWheelThreadLine + 2)},
    WheelDevices{.thread = K64Thread(mps2::kFirstWheelThreadLine + 3)}};
constinit mps2::NoOutput steeringStep;
constinit mps2::NoOutput steeringDirection;
constinit mps2::NoOutput steeringEnable;
constinit mps2::NoEdges leftEnd;
constinit mps2::NoEdges rightEnd;
constinit mps2::NoVoltage steeringAngle;
constinit mps2::NoEdges rcVelocityPin;
constinit mps2::NoEdges rcDirectionPin;
constinit mps2::CmsdkTimebase& rcEdgeTime = timebase;
constinit StartRecord startRecord;

void startDevices() {
  watchdog.start();
  timebase.start();
  pcPort.start();
}

void enableInterrupts() {
  for (const std::uint8_t line :
       {mps2::kReceiveLine, mps2::kSendLine, mps2::kFirstTimerLine, mps2::kSecondTimerLine}) {
    K64Thread::enable(line, kInterruptPriority);
  }
  for (std::uint8_t wheel = 0; wheel < kWheelCount; ++wheel) {
    K64Thread::enable(mps2::kFirstWheelThreadLine + wheel, kWheelThreadPriority);
  }
  K64Thread::enable(mps2::kMainThreadLine, kMainThreadPriority);
}

void sleepForever() {
  runningLight.set(true);
  for (;;) {
    rest();
  }
}

}  // namespace wr::platform

void rest() {
  asm volatile(
      "dsb\n\t"
      "wfi\n\t"
      ".global awake\n"
      ".thumb_func\n"
      "awake:" ::
          : "memory");
}

void pcPortInterrupt() {
  wr::platform::pcPort.serve();
  wr::finishStores();
}

void mainThreadInterrupt() {
  wr::platform::mainThread.runPended();
  wr::finishStores();
}

void frontLeftThreadInterrupt() {
  wr::platform::wheels[0].thread.runPended();
  wr::finishStores();
}

void frontRightThreadInterrupt() {
  wr::platform::wheels[1].thread.runPended();
  wr::finishStores();
}

void rearLeftThreadInterrupt() {
  wr::platform::wheels[2].thread.runPended();
  wr::finishStores();
}

void rearRightThreadInterrupt() {
  wr::platform::wheels[3].thread.runPended();
  wr::finishStores();
}
