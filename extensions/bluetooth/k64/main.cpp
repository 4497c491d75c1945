// The composition of the weeding robot that receives orders from the PC and a Bluetooth device: it
// constructs and connects the objects of this product.

#include <cstdint>
#include <optional>

#include "bluetooth/BluetoothDirector.hpp"
#include "bluetooth/RandomSource.hpp"
#include "bluetooth/k64/key.hpp"
#include "construction/MainControllerBuilder.hpp"
#include "k64/K64Board.hpp"
#include "k64/K64Thread.hpp"
#include "k64/K64Uart.hpp"
#include "k64/core.hpp"
#include "k64/start_up/control_systems.hpp"
#include "k64/start_up/handlers.hpp"
#include "k64/start_up/platform.hpp"
#include "safety/RetainedStop.hpp"
#include "safety/k64/program_check.hpp"
#include "safety/k64/stop_memory.hpp"

namespace wr {

namespace {

K64Uart bluetoothPort(K64Uart::Port::Uart4, platform::timebase);
MainControllerBuilder controllerBuilder({.thread = platform::mainThread,
                                         .cycleTimer = platform::cycleTimer,
                                         .timebase = platform::timebase,
                                         .pcPort = platform::pcPort,
                                         .watchdog = platform::watchdog,
                                         .start = platform::startRecord});
// Returns random numbers from the generator in the microcontroller.
class BoardRandom final : public RandomSource {
 public:
  std::optional<std::uint64_t> draw() override {
    constexpr unsigned kWordBits = 32;
    const std::optional<std::uint32_t> high = K64Board::randomWord();
    const std::optional<std::uint32_t> low = K64Board::randomWord();
    if (!high || !low) {
      return std::nullopt;
    }
    return std::uint64_t{*high} << kWordBits | *low;
  }
};

BoardRandom random;

[[gnu::section(".noinit")]] RetainedStop::Cells deviceStopCells;
RetainedStop deviceStop(deviceStopCells);

BluetoothDirector director(platform::poolBuilder, controllerBuilder,
                           {.port = bluetoothPort,
                            .key = bluetoothKey,
                            .random = random,
                            .timebase = platform::timebase,
                            .start = platform::startRecord,
                            .stops = {.pc = platform::stopMemory, .device = deviceStop}});

}  // namespace

}  // namespace wr

// Each handler ends with finishStores(). src/k64/start_up/platform.cpp states the reason.

void cycleTimerInterrupt() {
  wr::controllerBuilder.clock().expired();
  wr::finishStores();
}

void secondPortInterrupt() {
  wr::bluetoothPort.serve();
  wr::finishStores();
}

namespace wr {

void runRobot() {
  platform::startDevices();
  platform::stopMemory.begin(platform::startRecord.cause);
  platform::protectionMemory.begin(platform::startRecord);
  deviceStop.begin(platform::startRecord.cause);
  bluetoothPort.start();
  director.construct();
  K64Thread::enable(kSecondPortLine, kInterruptPriority);
  K64Thread::enable(kSecondPortErrorLine, kInterruptPriority);
  platform::enableInterrupts();
  director.start();
  platform::checkForever();
}

}  // namespace wr
