// The composition of a robot that receives orders from the PC and from the way-points of a field.

#include <array>
#include <optional>

#include "construction/MainControllerBuilder.hpp"
#include "k64/K64Board.hpp"
#include "k64/K64Thread.hpp"
#include "k64/K64Uart.hpp"
#include "k64/core.hpp"
#include "k64/start_up/control_systems.hpp"
#include "k64/start_up/handlers.hpp"
#include "k64/start_up/platform.hpp"
#include "main_control/operation_modes/BasicMode.hpp"
#include "main_control/operation_modes/PC.hpp"
#include "reading-modes/Waypoints.hpp"

namespace wr {

namespace {

constexpr std::array<FieldPoint, 2> kWay{{{300, 0}, {600, 50}}};

K64Uart gpsPort(K64Uart::Port::Uart4, platform::timebase, K64Uart::ZeroBytes::All);
MainControllerBuilder controllerBuilder({.thread = platform::mainThread,
                                         .cycleTimer = platform::cycleTimer,
                                         .timebase = platform::timebase,
                                         .pcPort = platform::pcPort,
                                         .watchdog = platform::watchdog,
                                         .start = platform::startRecord});

// The two reading modes. Each of the two modes changes to the other mode.
struct FieldModes {
  FieldModes(Reader& pcReader, PcConnection& connection)
      : reader(gpsPort, platform::timebase, kWay),
        basicPc(pcReader),
        basicWaypoints(reader),
        pc(basicPc, waypoints, connection),
        waypoints(basicWaypoints, pc, reader),
        all{&pc, &waypoints} {}

  WaypointReader reader;
  BasicMode basicPc;
  BasicMode basicWaypoints;
  PC pc;
  Waypoints waypoints;
  std::array<Mode*, 2> all;
};
std::optional<FieldModes> modes;

void construct() {
  platform::poolBuilder.buildSystems();
  platform::poolBuilder.buildPool();
  platform::poolBuilder.buildTimer();
  controllerBuilder.buildConnection();
  modes.emplace(controllerBuilder.pcReader(), controllerBuilder.connection());
  controllerBuilder.useModes(modes->pc, modes->all);
  controllerBuilder.buildStates();
  controllerBuilder.buildController(platform::poolBuilder.pool());
  controllerBuilder.buildClock();
}

}  // namespace

}  // namespace wr

// Each handler ends with finishStores(). src/k64/start_up/platform.cpp states the reason.

void cycleTimerInterrupt() {
  wr::controllerBuilder.clock().expired();
  wr::finishStores();
}

void secondPortInterrupt() {
  wr::gpsPort.serve();
  wr::finishStores();
}

namespace wr {

void runRobot() {
  platform::startDevices();
  gpsPort.start();
  construct();
  K64Thread::enable(kSecondPortLine, kInterruptPriority);
  K64Thread::enable(kSecondPortErrorLine, kInterruptPriority);
  platform::enableInterrupts();
  platform::poolBuilder.start();
  controllerBuilder.start();
  platform::sleepForever();
}

}  // namespace wr
