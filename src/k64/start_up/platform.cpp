#include "k64/start_up/platform.hpp"

#include <algorithm>

#include "k64/K64Board.hpp"
#include "k64/core.hpp"
#include "k64/pins.hpp"
#include "k64/start_up/handlers.hpp"

namespace wr::platform {

namespace {

constinit K64Adc::Converters converters{K64Adc::Converter(0), K64Adc::Converter(1)};
constinit K64Gpio greenLight(pinOf("light_green"), K64Gpio::Level::Low);

}  // namespace

constinit K64Watchdog watchdog;
constinit K64Timebase timebase;
constinit K64Pit cycleTimer(K64Pit::Channel::First);
constinit K64Pit tickTimer(K64Pit::Channel::Second);
K64Uart pcPort(K64Uart::Port::Uart0, timebase);
constinit K64Thread mainThread(kMainThreadLine);

constinit std::array<WheelDevices, kWheelCount> wheels{
    WheelDevices{.pwm = K64Ftm(K64Ftm::Channel::First),
                 .orientation = K64Gpio(pinOf("wheel_fl_orientation"), K64Gpio::Level::High),
                 .enable = K64Gpio(pinOf("wheel_fl_enable"), K64Gpio::Level::High),
                 .hallA = K64Port(pinOf("wheel_fl_hall_a")),
                 .hallB = K64Port(pinOf("wheel_fl_hall_b")),
                 .current = K64Adc(converters, K64Adc::channelOf("ADC0_SE12")),
                 .thread = K64Thread(kFirstWheelThreadLine)},
    WheelDevices{.pwm = K64Ftm(K64Ftm::Channel::Second),
                 .orientation = K64Gpio(pinOf("wheel_fr_orientation"), K64Gpio::Level::High),
                 .enable = K64Gpio(pinOf("wheel_fr_enable"), K64Gpio::Level::High),
                 .hallA = K64Port(pinOf("wheel_fr_hall_a")),
                 .hallB = K64Port(pinOf("wheel_fr_hall_b")),
                 .current = K64Adc(converters, K64Adc::channelOf("ADC0_SE13")),
                 .thread = K64Thread(kFirstWheelThreadLine + 1)},
    WheelDevices{.pwm = K64Ftm(K64Ftm::Channel::Third),
                 .orientation = K64Gpio(pinOf("wheel_rl_orientation"), K64Gpio::Level::High),
                 .enable = K64Gpio(pinOf("wheel_rl_enable"), K64Gpio::Level::High),
                 .hallA = K64Port(pinOf("wheel_rl_hall_a")),
                 .hallB = K64Port(pinOf("wheel_rl_hall_b")),
                 .current = K64Adc(converters, K64Adc::channelOf("ADC1_SE14")),
                 .thread = K64Thread(kFirstWheelThreadLine + 2)},
    WheelDevices{.pwm = K64Ftm(K64Ftm::Channel::Fourth),
                 .orientation = K64Gpio(pinOf("wheel_rr_orientation"), K64Gpio::Level::High),
                 .enable = K64Gpio(pinOf("wheel_rr_enable"), K64Gpio::Level::High),
                 .hallA = K64Port(pinOf("wheel_rr_hall_a")),
                 .hallB = K64Port(pinOf("wheel_rr_hall_b")),
                 .current = K64Adc(converters, K64Adc::channelOf("ADC1_SE15")),
                 .thread = K64Thread(kFirstWheelThreadLine + 3)},
};

constinit K64Gpio steeringStep(pinOf("steering_step"), K64Gpio::Level::High);
constinit K64Gpio steeringDirection(pinOf("steering_direction"), K64Gpio::Level::High);
constinit K64Gpio steeringEnable(pinOf("steering_enable"), K64Gpio::Level::High);
constinit K64Port leftEnd(pinOf("steering_left_end"));
constinit K64Port rightEnd(pinOf("steering_right_end"));
constinit K64Adc steeringAngle(converters, K64Adc::channelOf("ADC1_SE6b"));
constinit K64Port rcVelocityPin(pinOf("rc_velocity"));
constinit K64Port rcDirectionPin(pinOf("rc_direction"));
constinit K64Port rcEnablePin(pinOf("rc_enable"));
constinit K64Timebase::EntryTime rcEdgeTime(timebase);
constinit K64Port emergencyStopContact(pinOf("emergency_stop"));

constinit K64Gpio redLight(pinOf("light_red"), K64Gpio::Level::Low);

StartRecord startRecord;

RcEdges enterRcInterrupt() {
  rcEdgeTime.record();
  return {.velocity = rcVelocityPin.hasEdge(),
          .direction = rcDirectionPin.hasEdge(),
          .enable = rcEnablePin.hasEdge()};
}

bool hallEdgeWaits() {
  return std::ranges::any_of(wheels,
                             [](const WheelDevices& wheel) { return wheel.hallA.hasEdge(); });
}

void allowEdges() {
  for (WheelDevices& wheel : wheels) {
    wheel.hallA.allowEdges();
    wheel.hallB.allowEdges();
  }
  rcVelocityPin.allowEdges();
  rcDirectionPin.allowEdges();
  rcEnablePin.allowEdges();
}

void calibrateConverters() {
  K64Board::openGates();
  K64Adc::calibrate(converters);
}

void startDevices() {
  startRecord = K64Board::takeStartRecord();
  timebase.start();
  pcPort.start();
  K64Ftm::start();
  K64Board::connectLateOutputs();
}

void enableInterrupts() {
  for (const std::uint8_t line : {kPcPortLine, kPcPortErrorLine, kFirstConverterLine,
                                  kSecondConverterLine, kCycleTimerLine, kTickTimerLine}) {
    K64Thread::enable(line, kInterruptPriority);
  }
  K64Thread::enable(kRemoteControlLine, kPulsePriority);
  K64Thread::enable(kHallSensorLine, kEdgePriority);
  for (std::uint8_t wheel = 0; wheel < kWheelCount; ++wheel) {
    K64Thread::enable(kFirstWheelThreadLine + wheel, kWheelThreadPriority);
  }
  K64Thread::enable(kMainThreadLine, kMainThreadPriority);
}

void showRunning() {
  redLight.set(false);
  greenLight.set(true);
}

void sleepForever() {
  showRunning();
  for (;;) {
    timebase.sleep();
  }
}

}  // namespace wr::platform

// A handler clears its interrupt request with a store. If this store has not completed when the
// handler returns, the processor may enter the handler again (erratum 838869 of the core).
// Therefore each handler ends with finishStores(), which waits until all its stores have completed.

void pcPortInterrupt() {
  wr::platform::pcPort.serve();
  wr::finishStores();
}

void firstConverterInterrupt() {
  wr::K64Adc::serve(wr::platform::converters[0]);
  wr::finishStores();
}

void secondConverterInterrupt() {
  wr::K64Adc::serve(wr::platform::converters[1]);
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
