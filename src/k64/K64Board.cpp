#include "k64/K64Board.hpp"

#include <array>

#include "k64/K64Gpio.hpp"
#include "k64/core.hpp"
#include "k64/pins.hpp"
#include "k64/registers.hpp"

namespace wr {

namespace {

// Clock frequencies of the board and of the microcontroller. The static assertions check their
// limits.
constexpr std::uint32_t kExternalClock = 50'000'000;  // [Hz]
constexpr std::uint32_t kPllDivider = 20;             // 1 to 25
constexpr std::uint32_t kPllFactor = 48;              // 24 to 55
constexpr std::uint32_t kPllReference = kExternalClock / kPllDivider;
constexpr std::uint32_t kFlexBusClock = K64Board::kCoreClock / 3;
constexpr std::uint32_t kFlashClock = K64Board::kCoreClock / 5;
static_assert(kPllReference >= 2'000'000 && kPllReference <= 4'000'000,
              "the reference clock of the PLL must be within its limits");
static_assert(kPllReference * kPllFactor == K64Board::kCoreClock,
              "the PLL must generate the core clock");
static_assert(K64Board::kCoreClock / K64Board::kBusClock == 2 && K64Board::kBusClock <= 60'000'000);
static_assert(kFlexBusClock <= 50'000'000 && kFlashClock <= 25'000'000);

// Each field of the register CLKDIV1 contains a divisor minus 1.
constexpr auto divideBy(std::uint32_t divider, unsigned lowest) {
  return sim::CLKDIV1.field(divider - 1, lowest);
}

// The divisors after reset are too small for the full clock. Therefore the divisors are set before
// the clock becomes faster.
constexpr auto kDividers = divideBy(1, 28) | divideBy(2, 24) | divideBy(3, 20) | divideBy(5, 16);

// Greatest number of reads of the status register in one step of startClock(). If the step is not
// complete after these reads, it has failed. One read takes at least 8 and at most 20 periods of
// the core clock. The access to the register takes at least 2 of these periods. The other
// instructions of the loop take at least 6 periods. The core uses the internal FLL or the external
// clock. Even if three steps take 20 ms each, the fourth step fails before the watchdog time-out.
constexpr std::uint32_t kMaxClockPolls = 125'000;
constexpr std::uint64_t kMinPeriods = 8;
constexpr std::uint64_t kMaxPeriods = 20;
static_assert(kExternalClock >= K64Board::kFastestClockAfterReset &&
                  kMaxClockPolls * kMinPeriods * 1000 >= std::uint64_t{20} * kExternalClock,
              "the fastest kMaxClockPolls reads must take at least 20 ms");
static_assert(kMaxClockPolls * kMaxPeriods * 1000 <=
                  std::uint64_t{125} * K64Board::kSlowestClockAfterReset,
              "the slowest kMaxClockPolls reads must take at most 125 ms");

using Status = decltype(mcg::S)::Bits;

bool comes(Status mask, Status wanted) {
  for (std::uint32_t look = 0; look < kMaxClockPolls; ++look) {
    if ((mcg::S.read() & mask) == wanted) {
      return true;
    }
  }
  return false;
}

constexpr std::uint32_t kRetainedMark = 0x57656564;

// The fault record is in a part of RAM that the start-up code does not initialise. After power-on
// its content is undefined.
struct FaultRecord {
  std::uint32_t mark;
  std::uint32_t kind;
  std::uint32_t number;
  std::uint32_t address;
  std::uint32_t check;

  [[nodiscard]] std::uint32_t sum() const { return mark ^ kind ^ (number << 16U) ^ address; }

  [[nodiscard]] bool holds() const {
    return mark == kRetainedMark && check == ~sum() && kind != 0 &&
           kind <= static_cast<std::uint32_t>(FaultKind::ClockFailed);
  }
};

[[gnu::section(".noinit")]] FaultRecord faultRecord;

void recordFault(FaultKind kind, std::uint16_t number, std::uint32_t address) {
  faultRecord.mark = kRetainedMark;
  faultRecord.kind = static_cast<std::uint32_t>(kind);
  faultRecord.number = number;
  faultRecord.address = address;
  faultRecord.check = ~faultRecord.sum();
  finishStores();
}

// Waits in an endless loop for the reset. If the core has not requested a reset, the watchdog
// causes the reset.
[[noreturn]] void awaitReset() {
  for (;;) {
    asm volatile("nop");
  }
}

ResetCause resetCause() {
  const auto first = rcm::SRS0.read();
  const auto second = rcm::SRS1.read();
  if ((first & rcm::SRS0_POR).any()) {
    return ResetCause::PowerOn;
  }
  if ((first & rcm::SRS0_LVD).any()) {
    return ResetCause::LowVoltage;
  }
  if ((first & rcm::SRS0_WDOG).any()) {
    return ResetCause::Watchdog;
  }
  if ((first & (rcm::SRS0_LOC | rcm::SRS0_LOL)).any()) {
    return ResetCause::ClockLost;
  }
  if ((second & rcm::SRS1_LOCKUP).any()) {
    return ResetCause::Lockup;
  }
  if ((second & rcm::SRS1_SW).any()) {
    return ResetCause::Software;
  }
  if ((second & (rcm::SRS1_JTAG | rcm::SRS1_MDM_AP)).any()) {
    return ResetCause::Debugger;
  }
  return (first & rcm::SRS0_PIN).any() ? ResetCause::Pin : ResetCause::Unknown;
}

void connect(const Pin& pin, Mux to) {
  const auto control = port::PCR.at(static_cast<std::uint32_t>(pin.port) * port::kPortDistance +
                                    pin.number * port::kPinDistance);
  const auto mux = port::PCR.field(static_cast<std::uint32_t>(to), port::kMuxLowest);
  if (pin.isOutput()) {
    // The drive strength is high, because the output may have to drive the LED of an optocoupler.
    control.write(mux | port::PCR_DSE);
  } else if (pin.role == Role::Input || pin.role == Role::PulledUp) {
    control.write(mux | port::PCR_PE | port::PCR_PS);
  } else {
    control.write(mux);
  }
}

// Switches on the digital filters of the port of the Hall sensors. The length of the filters is 31
// bus clocks. At the full clock the filters suppress pulses shorter than 0.5 us. No other port has
// digital filters.
void filterHallSensors() {
  constexpr std::uint32_t kWidth = 31;
  constexpr auto kPort = static_cast<std::uint32_t>(Port::D) * port::kPortDistance;
  std::uint32_t pins = 0;
  for (const Pin& pin : kPins) {
    if (pin.port == Port::D && pin.role == Role::Input) {
      pins |= std::uint32_t{1} << pin.number;
    }
  }
  port::DFER.at(kPort).write({0});  // clock and width may change only while no filter is on
  port::DFCR.at(kPort).write({0});  // the filters use the bus clock
  port::DFWR.at(kPort).write({kWidth});
  port::DFER.at(kPort).write({pins});
}

}  // namespace

void K64Board::makeOutputsSafe() {
  sim::SCGC5.set(sim::SCGC5_PORTA | sim::SCGC5_PORTB | sim::SCGC5_PORTC | sim::SCGC5_PORTD |
                 sim::SCGC5_PORTE);
  for (const Pin& pin : kPins) {
    if (pin.isOutput()) {
      K64Gpio::makeSafe(pin);
      connect(pin, Mux::Gpio);
    }
  }
}

void K64Board::connectInputs() {
  for (const Pin& pin : kPins) {
    if (!pin.isOutput()) {
      connect(pin, pin.mux);
    }
  }
  filterHallSensors();
}

void K64Board::connectLateOutputs() {
  for (const Pin& pin : kPins) {
    if (pin.role == Role::LateOutput) {
      connect(pin, pin.mux);
    }
  }
}

void K64Board::enableFloatingPoint() {
  scb::CPACR.set(scb::CPACR_FPU);
  finishInstructions();
}

void K64Board::enableGuards() {
  scb::CCR.set(scb::CCR_DIV_0_TRP);
  pmc::LVDSC1.write(pmc::LVDSC1_LVDRE | pmc::LVDSC1_LVDV_HIGH);
}

void K64Board::moveVectors(const std::uint32_t* table) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): the register contains an address
  scb::VTOR.write({reinterpret_cast<std::uint32_t>(table)});
  finishStores();
}

std::uint16_t K64Board::startClock() {
  sim::CLKDIV1.write(kDividers);
  // The core uses the internal FLL until the external clock runs. The frequency of the FLL may jump
  // when its reference changes (erratum 7993). A jump does no harm here: the divisors are set, the
  // core uses this clock only for some microseconds, and no device uses this clock.
  mcg::C2.write(mcg::C2_LOCRE0 | mcg::C2_RANGE_VERY_HIGH);
  mcg::C1.write(mcg::C1_CLKS_PLL_FLL | mcg::C1_FRDIV_1536);
  if (!comes(mcg::S_IREFST, {})) {
    return 1;
  }
  mcg::C1.write(mcg::C1_CLKS_EXTERNAL | mcg::C1_FRDIV_1536);
  if (!comes(mcg::S_CLKST, mcg::S_CLKST_EXTERNAL)) {
    return 2;
  }
  mcg::C5.write(mcg::C5.field(kPllDivider - 1, 0));
  mcg::C6.write(mcg::C6_PLLS | mcg::C6.field(kPllFactor - 24, 0));
  if (!comes(mcg::S_PLLST | mcg::S_LOCK0, mcg::S_PLLST | mcg::S_LOCK0)) {
    return 3;
  }
  mcg::C1.write(mcg::C1_CLKS_PLL_FLL | mcg::C1_FRDIV_1536);
  if (!comes(mcg::S_CLKST, mcg::S_CLKST_PLL)) {
    return 4;
  }
  // From now on a reset occurs when the external clock fails or the PLL loses its lock.
  mcg::C8.set(mcg::C8_LOLRE);
  mcg::C6.set(mcg::C6_CME0);
  return 0;
}

void K64Board::openGates() {
  sim::SCGC1.set(sim::SCGC1_UART4);
  sim::SCGC3.set(sim::SCGC3_ADC1);
  sim::SCGC4.set(sim::SCGC4_UART0);
  sim::SCGC6.set(sim::SCGC6_RNGA | sim::SCGC6_PIT | sim::SCGC6_FTM0 | sim::SCGC6_ADC0);
}

StartRecord K64Board::takeStartRecord() {
  StartRecord record{.cause = resetCause()};
  if (faultRecord.holds()) {
    record.fault = static_cast<FaultKind>(faultRecord.kind);
    record.number = static_cast<std::uint16_t>(faultRecord.number);
    record.address = faultRecord.address;
  }
  faultRecord.mark = 0;
  return record;
}

void K64Board::endWithFault(FaultKind kind, std::uint16_t number, std::uint32_t address) {
  closeInterrupts();
  makeOutputsSafe();
  recordFault(kind, number, address);
  scb::AIRCR.write(scb::AIRCR_VECTKEY | scb::AIRCR_SYSRESETREQ);
  finishStores();
  awaitReset();
}

void K64Board::endWithoutClock(std::uint16_t step) {
  closeInterrupts();
  makeOutputsSafe();
  recordFault(FaultKind::ClockFailed, step, 0);
  awaitReset();
}

FaultKind K64Board::faultOf(std::uint16_t exception) {
  constexpr std::uint16_t kHardFault = 3;
  constexpr std::array kFaults = {FaultKind::HardFault, FaultKind::MemoryFault, FaultKind::BusFault,
                                  FaultKind::UsageFault};
  if (exception < kHardFault || exception >= kHardFault + kFaults.size()) {
    return FaultKind::UnexpectedInterrupt;
  }
  if (exception > kHardFault) {
    return kFaults[exception - kHardFault];
  }
  // The separate handlers of memory, bus and usage faults are not enabled. Therefore each of these
  // faults causes a hard fault, and the status register contains the kind of the fault.
  const auto status = scb::CFSR.read();
  if ((status & scb::CFSR_MEMORY).any()) {
    return FaultKind::MemoryFault;
  }
  if ((status & scb::CFSR_BUS).any()) {
    return FaultKind::BusFault;
  }
  return (status & scb::CFSR_USAGE).any() ? FaultKind::UsageFault : FaultKind::HardFault;
}

// The generator needs 256 bus clocks for a word. Each read of SR takes more than 4 clock periods of
// the core. Therefore kMostLooks reads take much longer than the generator needs.
std::optional<std::uint32_t> K64Board::randomWord() {
  constexpr std::uint32_t kMostLooks = 2'000;
  rng::CR.write(rng::CR_GO | rng::CR_HA | rng::CR_INTM);
  for (std::uint32_t look = 0; look < kMostLooks; ++look) {
    if ((rng::SR.read() & rng::SR_OREG_LVL).any()) {
      return rng::OR.read().value;
    }
  }
  return std::nullopt;
}

}  // namespace wr
