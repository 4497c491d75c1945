#include "sim/faults/InjectedFault.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "sim/emulator/Event.hpp"

namespace wr::faults {

namespace {

using plant::Fault;  // faults of sensors

struct Share {
  Kind kind;
  std::uint32_t percent;
  std::string_view name;
};

constexpr std::array<Share, kKinds> kShares{{
    {Kind::Ram, 22, "ram"},
    {Kind::Code, 22, "code"},
    {Kind::Stack, 10, "stack"},
    {Kind::Register, 14, "register"},
    {Kind::Flash, 4, "flash"},
    {Kind::Interrupt, 10, "interrupt"},
    {Kind::Sensor, 8, "sensor"},
    {Kind::Serial, 4, "serial"},
    {Kind::Clock, 3, "clock"},
    {Kind::Supply, 3, "supply"},
}};

struct SensorFault {
  Fault fault;
  int least;
  int most;
};

constexpr std::array<SensorFault, 10> kSensorFaults{{
    {Fault::Hall, 0, 0},
    {Fault::HallA, 0, 0},
    {Fault::HallB, 0, 0},
    {Fault::HallGlitches, 1, 60},
    {Fault::HallLosses, 1, 60},
    {Fault::Current, 0, 0},
    {Fault::CurrentStuck, 0, 0},
    {Fault::CurrentOffset, -8000, 8000},
    {Fault::AngleStuck, 0, 0},
    {Fault::AngleDrift, -500, 500},
}};

constexpr std::uint32_t kCoreRegisters = 16;
constexpr int kForEver = 0;
// Values of InjectedFault::bit. 0: the interrupt line is blocked; 1: an interrupt is raised without
// a cause
constexpr std::uint32_t kHeld = 0;
constexpr std::uint32_t kFirstException = 16;
constexpr std::uint32_t kNominalBaud = 115'200;

enum ClockFault : std::uint32_t { OtherBaud, NoClock, NoLock, ClockFaults };

constexpr std::array<emulator::Reset, 3> kSupplyFaults{
    emulator::Reset::LowVoltage, emulator::Reset::PowerOn, emulator::Reset::Pin};

InjectedFault chooseInterrupt(Random& random, const Places& places) {
  const std::uint32_t line = random.below(static_cast<std::uint32_t>(places.interrupts.size()));
  InjectedFault fault{Kind::Interrupt, static_cast<std::uint32_t>(places.interrupts[line]),
                      random.below(2)};
  // On average, nine of ten blocked interrupt lines are blocked for 1 ms to 100 ms. The slowest
  // interrupt has a period of 100 ms. One of ten lines stays blocked forever.
  fault.value = random.below(10) == 0 ? kForEver : random.between(1, 100);
  return fault;
}

InjectedFault chooseSensor(Random& random) {
  const std::uint32_t number = random.below(kSensorFaults.size());
  const SensorFault& chosen = kSensorFaults.at(number);
  const std::uint32_t wheel = random.below(plant::kWheels);
  return {Kind::Sensor, number, wheel, random.between(chosen.least, chosen.most)};
}

// Returns true if the error of a sensor accumulates, because the error grows or occurs repeatedly.
bool addsUp(Fault fault) {
  return fault == Fault::AngleDrift || fault == Fault::HallLosses;
}

void flipRegister(const InjectedFault& fault, emulator::VirtualBoard& board) {
  board.setCore(fault.place, board.core(fault.place) ^ 1U << fault.bit);
}

void injectClock(const InjectedFault& fault, emulator::VirtualBoard& board) {
  if (fault.place == NoClock) {
    board.setExternalClock(false);
  } else if (fault.place == NoLock) {
    board.loseLock();
  } else {  // the value is the deviation of the baud rate in thousandths
    board.setLineBaud(static_cast<std::uint32_t>(
        static_cast<int>(kNominalBaud) + static_cast<int>(kNominalBaud) / 1000 * fault.value));
  }
}

}  // namespace

std::string_view nameOf(Kind kind) {
  return kShares.at(static_cast<std::size_t>(kind)).name;
}

std::optional<Kind> kindOf(std::string_view name) {
  const auto found = std::ranges::find(kShares, name, &Share::name);
  return found == kShares.end() ? std::nullopt : std::optional(found->kind);
}

int windowOf(const InjectedFault& fault) {
  constexpr int kWindow = 1000;
  constexpr int kOfSurroundings = 1800;
  constexpr int kOfSensor = 3000;
  switch (fault.kind) {
    case Kind::Sensor:
      return addsUp(kSensorFaults.at(fault.place).fault) ? kLongestWindow : kOfSensor;
    case Kind::Serial:
    case Kind::Clock:
      return kOfSurroundings;
    default:
      return kWindow;
  }
}

Kind chooseKind(Random& random) {
  std::uint32_t number = random.below(100);
  for (const Share& share : kShares) {
    if (number < share.percent) {
      return share.kind;
    }
    number -= share.percent;
  }
  return Kind::Ram;
}

InjectedFault choose(Kind kind, Random& random, const Places& places, std::uint32_t stack) {
  const auto byteOf = [&](std::uint32_t begin, std::uint32_t end) {
    const std::uint32_t address = begin + random.below(std::max(end, begin + 1) - begin);
    return InjectedFault{kind, address, random.below(8)};
  };
  switch (kind) {
    case Kind::Ram:
      return byteOf(places.dataBegin, places.dataEnd);
    case Kind::Code:
      return byteOf(places.codeBegin, places.codeEnd);
    case Kind::Stack:
      return byteOf(std::min(stack, places.stackEnd - 1), places.stackEnd);
    case Kind::Flash:
      return byteOf(0, places.flashEnd);
    case Kind::Register:
      return {kind, random.below(kCoreRegisters), random.below(32)};
    case Kind::Interrupt:
      return chooseInterrupt(random, places);
    case Kind::Sensor:
      return chooseSensor(random);
    case Kind::Serial:
      return {kind, 0, 0, random.between(1, 20)};
    case Kind::Clock:
      return {kind, random.below(ClockFaults), 0, random.between(-25, 25)};
    case Kind::Supply:
      break;
  }
  return {kind, random.below(kSupplyFaults.size())};
}

void inject(const InjectedFault& fault, board_robot::BoardSession& robot) {
  emulator::VirtualBoard& board = robot.board;
  switch (fault.kind) {
    case Kind::Ram:
    case Kind::Code:
    case Kind::Stack:
    case Kind::Flash:
      board.flipBit(fault.place, fault.bit);
      break;
    case Kind::Register:
      flipRegister(fault, board);
      break;
    case Kind::Interrupt:
      if (fault.bit == kHeld) {
        board.holdInterrupt(static_cast<int>(fault.place), true);
      } else {
        board.raise(static_cast<int>(kFirstException + fault.place));
      }
      break;
    case Kind::Sensor:
      robot.robot().setFault(kSensorFaults.at(fault.place).fault, fault.bit, true, fault.value);
      break;
    case Kind::Serial:
      break;
    case Kind::Clock:
      injectClock(fault, board);
      break;
    case Kind::Supply:
      board.reset(kSupplyFaults.at(fault.place));
      break;
  }
}

void endIfDue(const InjectedFault& fault, int ms, board_robot::BoardSession& robot) {
  if (fault.kind == Kind::Interrupt && fault.bit == kHeld && fault.value != kForEver &&
      ms == fault.value) {
    robot.board.holdInterrupt(static_cast<int>(fault.place), false);
  }
}

int noiseOf(const InjectedFault& fault) {
  return fault.kind == Kind::Serial ? fault.value : 0;
}

}  // namespace wr::faults
