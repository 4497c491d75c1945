#include "sim/emulator/VirtualBoard.hpp"

#include <algorithm>
#include <array>
#include <bitset>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "sim/emulator/Adc.hpp"
#include "sim/emulator/Blocks.hpp"
#include "sim/emulator/CallRecorder.hpp"
#include "sim/emulator/Clock.hpp"
#include "sim/emulator/CortexM4.hpp"
#include "sim/emulator/DebugPort.hpp"
#include "sim/emulator/FlexCan.hpp"
#include "sim/emulator/Ftm.hpp"
#include "sim/emulator/Mcg.hpp"
#include "sim/emulator/Peripheral.hpp"
#include "sim/emulator/PinFunctions.hpp"
#include "sim/emulator/Pins.hpp"
#include "sim/emulator/Pit.hpp"
#include "sim/emulator/PlainRegisters.hpp"
#include "sim/emulator/Rcm.hpp"
#include "sim/emulator/RegisterNames.hpp"
#include "sim/emulator/Rnga.hpp"
#include "sim/emulator/Sim.hpp"
#include "sim/emulator/StimulusQueue.hpp"
#include "sim/emulator/Uart.hpp"
#include "sim/emulator/Wdog.hpp"
#include "sim/emulator/hexText.hpp"
#include "sim/emulator/locate.hpp"

namespace wr::emulator {

namespace {

// K64P144M120SF5RM, chapter Memory Map.
constexpr std::uint32_t kFlashSize = 0x100000;
constexpr std::uint32_t kRamLower = 0x1FFF0000;
constexpr std::uint32_t kRamLowerSize = 0x10000;
constexpr std::uint32_t kRamUpper = 0x20000000;
constexpr std::uint32_t kRamUpperSize = 0x30000;
constexpr std::uint32_t kPeripherals = 0x40000000;
constexpr std::uint32_t kGpio = 0x400FF000;
constexpr std::uint32_t kGpioSize = 0x40;
constexpr std::uint32_t kPeripheralsSize = 0x100000;
constexpr std::uint32_t kSimUpper = 0x40048000;

constexpr std::uint32_t kFlashOption = 0x40D;  // FOPT
constexpr std::uint8_t kNormalBoot = 1U << 0;  // FOPT.LPBOOT
constexpr std::uint8_t kNmiEnabled = 1U << 2;  // FOPT.NMI_DIS: 0 blocks the NMI
constexpr unsigned kNmiPin = 4;                // PTA4
constexpr unsigned kNmi = 2;
constexpr unsigned kFirstLine = 16;
constexpr unsigned kLines = 110;
constexpr unsigned kPriorityBits = 4;
constexpr unsigned kPorts = 5;
constexpr unsigned kTimers = 4;
constexpr unsigned kConverters = 2;

// For clocks, FIFOs and interrupt lines, see K64P144M120SF5RM, Chip Configuration, UART and
// interrupt channel assignments.
constexpr Uart::Kind kUart0{.number = 0, .coreClock = true, .fifo = 0x22, .line = 31};
constexpr Uart::Kind kUart4{.number = 4, .coreClock = false, .fifo = 0x00, .line = 66};

// Blocks whose registers only store the written values. See K64P144M120SF5RM, chapters OSC, SMC,
// PMC (LVDSC1, LVDSC2, REGSC), and Memory Protection Unit (MPU).
constexpr std::array<PlainRegister, 1> kOsc{{{0x0, 0x00, 0xAF}}};
constexpr std::array<PlainRegister, 4> kSmc{
    {{0x0, 0x00, 0x2A}, {0x1, 0x00, 0x00}, {0x2, 0x03, 0x27}, {0x3, 0x01, 0x00}}};
constexpr std::array<PlainRegister, 3> kPmc{
    {{0x0, 0x10, 0x33}, {0x1, 0x00, 0x23}, {0x2, 0x04, 0x11}}};
constexpr std::array<PlainRegister, 1> kSysmpu{{{0x0, 0x00815101, 0x00000001}}};

constexpr std::string_view kUnmodelled = "unmodelled-register";

std::string megahertz(std::uint64_t hz) {
  return std::to_string(hz / 1'000'000) + " MHz";
}

}  // namespace

/// @brief The microcontroller with its processor, memories and peripherals.
class VirtualBoard::Parts final : public Microcontroller {
 public:
  Parts(std::vector<std::uint8_t> image, Options options)
      : options_(std::move(options)),
        image_(std::move(image)),
        cpu_(kLines, kPriorityBits, options_.timing),
        sim_(*this, hasOption(kNormalBoot)),
        mcg_(*this, options_.externalClock, options_.failingClockStep),
        osc_(*this, "OSC", 1, kOsc),
        smc_(*this, "SMC", 1, kSmc),
        pmc_(*this, "PMC", 1, kPmc),
        sysmpu_(*this, "SYSMPU", 4, kSysmpu),
        wdog_(*this),
        rcm_(*this),
        rng_(*this),
        can_(*this),
        pit_(*this),
        uarts_{Uart(*this, kUart0), Uart(*this, kUart4)},
        ftms_{Ftm(*this, 0, 8), Ftm(*this, 1, 2), Ftm(*this, 2, 2), Ftm(*this, 3, 8)},
        adcs_{Adc(*this, 0, options_.calibrates[0]), Adc(*this, 1, options_.calibrates[1])},
        ports_{Port(*this, 0, pins_[0]), Port(*this, 1, pins_[1]), Port(*this, 2, pins_[2]),
               Port(*this, 3, pins_[3]), Port(*this, 4, pins_[4])},
        gpios_{Gpio(*this, pins_[0], ports_[0]), Gpio(*this, pins_[1], ports_[1]),
               Gpio(*this, pins_[2], ports_[2]), Gpio(*this, pins_[3], ports_[3]),
               Gpio(*this, pins_[4], ports_[4])},
        byName_{{"SIM", &sim_},        {"MCG", &mcg_},        {"OSC", &osc_},
                {"SMC", &smc_},        {"PMC", &pmc_},        {"SYSMPU", &sysmpu_},
                {"WDOG", &wdog_},      {"RCM", &rcm_},        {"RNG", &rng_},
                {"PIT", &pit_},        {"UART0", &uarts_[0]}, {"UART4", &uarts_[1]},
                {"FTM0", &ftms_[0]},   {"FTM1", &ftms_[1]},   {"FTM2", &ftms_[2]},
                {"FTM3", &ftms_[3]},   {"ADC0", &adcs_[0]},   {"ADC1", &adcs_[1]},
                {"PORTA", &ports_[0]}, {"PORTB", &ports_[1]}, {"PORTC", &ports_[2]},
                {"PORTD", &ports_[3]}, {"PORTE", &ports_[4]}, {"CAN0", &can_}},
        timed_{&mcg_,     &wdog_,    &pit_,     &uarts_[0], &uarts_[1], &ftms_[0], &ftms_[1],
               &ftms_[2], &ftms_[3], &adcs_[0], &adcs_[1],  &ports_[3], &can_},
        agenda_([this](const StimulusQueue::Level& level) {
          drive(level.port, level.pin, level.high);
        }) {
    if (image_.size() > kFlashSize) {
      throw std::runtime_error(
          "the firmware image is larger than the flash of 1 MiB; check its path");
    }
    build();
    connect();
    powerOn();
  }

  // The interface of the peripherals.
  [[nodiscard]] Time time() const override {
    if (core_.hz() == 0) {
      return standsAt_;
    }
    if (const std::uint64_t cycle = cpu_.cycles(); cycle != knownCycle_) {
      knownCycle_ = cycle;
      knownTime_ = core_.at(cycle);
    }
    return knownTime_;
  }
  [[nodiscard]] const Clock& coreClock() const override { return core_; }
  [[nodiscard]] const Clock& busClock() const override { return bus_; }
  void setLine(unsigned line, bool high) override;
  void raiseNmi() override {
    if (hasOption(kNmiEnabled)) {
      cpu_.raise(kNmi);
    }
  }
  void clocksChanged() override;
  void report(std::string id, std::string what) override;
  void refuse(std::string id, std::string what) override {
    if (debugs_) {
      debugRefused_ = true;
      return;
    }
    cpu_.refuse(access_->address, std::move(id), std::move(what));
  }
  void requestReset(Reset cause, std::string id, std::string what) override;
  void tell(Event::Kind kind, std::uint32_t number, std::uint32_t value) override {
    if (event) {
      event({kind, now(), number, value});
    }
  }

  // The public interface of the board.
  [[nodiscard]] nanoseconds now() const { return std::chrono::duration_cast<nanoseconds>(time()); }
  template <typename Done>
  bool runUntil(Time limit, Done done);
  void resetNow(Reset cause);
  void hold(unsigned line, bool held);
  [[nodiscard]] PinState& port(char name) { return pins_.at(static_cast<std::size_t>(name - 'A')); }
  void drive(char name, unsigned pin, bool level);

  CortexM4& cpu() { return cpu_; }
  DebugPort& debugPort() { return debugPort_; }
  Mcg& mcg() { return mcg_; }
  Uart& uart(int number);
  FlexCan& can() { return can_; }
  Ftm& ftm(int number) { return ftms_.at(static_cast<std::size_t>(number)); }
  Adc& adc(int number) { return adcs_.at(static_cast<std::size_t>(number)); }
  StimulusQueue& agenda() { return agenda_; }
  void renew(Peripheral& peripheral);
  void limitTo(Time time);
  [[nodiscard]] const Clock& core() const { return core_; }
  [[nodiscard]] bool sleeps() const { return sleeps_; }
  [[nodiscard]] std::uint64_t sleptCycles() const { return sleptCycles_; }

  std::function<void(const Event&)> event;
  std::function<void(std::uint32_t, unsigned, std::uint32_t)> written;
  CallRecorder* recorder = nullptr;
  std::optional<Finding> finding;
  std::vector<Finding> warnings;
  int resets = 0;
  unsigned awaited = 0;  ///< number of the processor's exception that ends the run
  bool awaitedCame = false;

 private:
  /// Returns whether a bit of the flash option byte is 1. All bits of erased flash are 1.
  [[nodiscard]] bool hasOption(std::uint8_t bit) const {
    return image_.size() <= kFlashOption || (image_[kFlashOption] & bit) != 0;
  }
  void build();
  void connect();
  void powerOn();
  void fillRam();
  std::uint32_t read(std::uint32_t address, unsigned size);
  void write(std::uint32_t address, unsigned size, std::uint32_t value);
  bool debugRead(std::uint32_t address, unsigned size, std::uint32_t& value);
  bool debugWrite(std::uint32_t address, unsigned size, std::uint32_t value);
  std::uint32_t load(std::uint32_t address, unsigned size);
  void store(std::uint32_t address, unsigned size, std::uint32_t value);
  Peripheral* peripheralAt(std::uint32_t address, std::uint32_t& offset, bool store);
  [[nodiscard]] Time nextEvent() const;
  void advance();
  bool runCore(Time until);
  [[nodiscard]] Finding findingOf(const CortexM4::Problem& problem) const;
  bool warn(const std::string& what);
  void checkClocks();
  void gatesChanged();
  void renewAll();
  [[nodiscard]] bool hasPin(std::span<const PinFunction> pins, unsigned instance,
                            unsigned channel) const;
  [[nodiscard]] Adc::Input inputOf(unsigned converter, unsigned channel) const;
  [[nodiscard]] const PinState& pinsOf(char port) const {
    return pins_[static_cast<std::size_t>(port - 'A')];
  }

  Options options_;
  std::vector<std::uint8_t> image_;
  CortexM4 cpu_;
  Clock core_;
  Clock bus_;
  Time standsAt_{0};
  std::array<PinState, kPorts> pins_{};
  Sim sim_;
  Mcg mcg_;
  PlainRegisters osc_;
  PlainRegisters smc_;
  PlainRegisters pmc_;
  PlainRegisters sysmpu_;
  Wdog wdog_;
  Rcm rcm_;
  Rnga rng_;
  FlexCan can_;
  Pit pit_;
  std::array<Uart, 2> uarts_;
  std::array<Ftm, kTimers> ftms_;
  std::array<Adc, kConverters> adcs_;
  std::array<Port, kPorts> ports_;
  std::array<Gpio, kPorts> gpios_;
  std::map<std::string_view, Peripheral*> byName_;
  std::array<Peripheral*, 13> timed_;  ///< peripherals that schedule events
  StimulusQueue agenda_;
  struct Place {
    const Block* block = nullptr;
    Peripheral* peripheral = nullptr;
  };
  std::array<Place, kPeripheralsSize / kBlockSize> places_{};
  struct Access {
    std::uint32_t address = 0;
    bool store = false;
  };
  std::optional<Access> access_;  ///< the present access to a peripheral
  std::set<std::string> warned_;
  bool pitGate_ = false;
  mutable std::uint64_t knownCycle_ = 0;
  mutable Time knownTime_{0};
  bool sleeps_ = false;
  std::uint64_t sleptCycles_ = 0;
  std::bitset<128> lines_;
  std::bitset<128> held_;  ///< interrupt lines that are hidden from the processor
  std::optional<Reset> wantedReset_;
  bool debugs_ = false;        ///< the present access is from a debugger and causes no finding
  bool debugRefused_ = false;  ///< the access of the debugger was refused
  DebugPort debugPort_{
      cpu_,
      {.read = [this](std::uint32_t address, unsigned size,
                      std::uint32_t& value) { return debugRead(address, size, value); },
       .write = [this](std::uint32_t address, unsigned size,
                       std::uint32_t value) { return debugWrite(address, size, value); },
       .now = [this] { return now(); }}};
};

void VirtualBoard::Parts::build() {
  std::vector<std::uint8_t> flash(kFlashSize, 0xFF);
  std::ranges::copy(image_, flash.begin());
  cpu_.mapMemory(0, kFlashSize, CortexM4::Access::ReadExecute);
  cpu_.mapMemory(kRamLower, kRamLowerSize, CortexM4::Access::ReadWriteExecute);
  cpu_.mapMemory(kRamUpper, kRamUpperSize, CortexM4::Access::ReadWriteExecute);
  cpu_.load(0, flash);
  cpu_.mapWindow(
      kPeripherals, kPeripheralsSize,
      [this](std::uint32_t address, unsigned size) { return read(address, size); },
      [this](std::uint32_t address, unsigned size, std::uint32_t value) {
        write(address, size, value);
      });
  for (const Block& block : kBlocks) {
    const auto found = byName_.find(block.name);
    places_[(block.base - kPeripherals) / kBlockSize] = {
        &block, found == byName_.end() ? nullptr : found->second};
  }
  places_[(kSimUpper - kPeripherals) / kBlockSize] =
      places_[(kSimUpper - kPeripherals) / kBlockSize - 1];
}

void VirtualBoard::Parts::connect() {
  uarts_[0].connectPins([this] { return hasPin(kUartPins, 0, kReceive); },
                        [this] { return hasPin(kUartPins, 0, kSend); });
  uarts_[1].connectPins([this] { return hasPin(kUartPins, 4, kReceive); },
                        [this] { return hasPin(kUartPins, 4, kSend); });
  can_.connectPins([this] { return hasPin(kCanPins, 0, kReceive) && hasPin(kCanPins, 0, kSend); });
  for (unsigned i = 0; i < kTimers; ++i) {
    ftms_[i].connectPins([this, i](unsigned channel) { return hasPin(kFtmPins, i, channel); });
  }
  for (unsigned i = 0; i < kConverters; ++i) {
    adcs_[i].connectPins([this, i](unsigned channel) { return inputOf(i, channel); });
  }
  cpu_.setFaultsAreProblems(options_.faultsAreFindings);
  cpu_.onUnmodelled([this](const std::string& what) { return warn(what); });
  cpu_.onException([this](CortexM4::Step step, unsigned exception) {
    const bool entered = step == CortexM4::Step::Entered;
    tell(entered ? Event::Kind::ExceptionEntered : Event::Kind::ExceptionLeft, exception, 0);
    if (recorder != nullptr) {
      entered ? recorder->exceptionEntered(cpu_.pc(), cpu_.core(13)) : recorder->exceptionLeft();
    }
    if (entered && exception == awaited) {
      awaitedCame = true;
      cpu_.stop();
    }
  });
  cpu_.onResetRequest(
      [this] { requestReset(Reset::Software, "reset-request", "the program asks for a reset"); });
  cpu_.onLockup(
      [this] { requestReset(Reset::Lockup, "lockup", "a fault in the handler of a fault"); });
}

bool VirtualBoard::Parts::hasPin(std::span<const PinFunction> pins, unsigned instance,
                                 unsigned channel) const {
  return std::ranges::any_of(pins, [&](const PinFunction& each) {
    return each.instance == instance && each.channel == channel &&
           pinsOf(each.port).function(each.pin) == each.function;
  });
}

Adc::Input VirtualBoard::Parts::inputOf(unsigned converter, unsigned channel) const {
  constexpr std::span<const PinFunction> kPins(kAdcPins);
  const auto found = std::ranges::find_if(kPins, [&](const PinFunction& each) {
    return each.instance == converter && each.channel == channel;
  });
  if (found == kPins.end()) {
    return Adc::Input::None;
  }
  return pinsOf(found->port).function(found->pin) == 0 ? Adc::Input::Analog : Adc::Input::Digital;
}

Uart& VirtualBoard::Parts::uart(int number) {
  if (number != 0 && number != 4) {
    throw std::invalid_argument("the board has no serial line at UART" + std::to_string(number));
  }
  return uarts_[number == 0 ? 0 : 1];
}

void VirtualBoard::Parts::fillRam() {
  // The content of RAM after power-on is undefined. The model uses fixed values.
  std::vector<std::uint8_t> content(kRamUpperSize);
  std::uint32_t state = 0x12345678;
  for (std::uint8_t& byte : content) {
    state = state * 1'664'525U + 1'013'904'223U;
    byte = static_cast<std::uint8_t>(state >> 24);
  }
  cpu_.load(kRamUpper, content);
  cpu_.load(kRamLower, std::span(content).first(kRamLowerSize));
}

void VirtualBoard::Parts::powerOn() {
  resetNow(Reset::PowerOn);
  resets = 0;
}

void VirtualBoard::Parts::resetNow(Reset cause) {
  wantedReset_.reset();
  sleeps_ = false;
  if (cause == Reset::PowerOn) {
    fillRam();
  }
  sim_.reset(cause);
  mcg_.reset(cause);
  clocksChanged();
  for (const auto& [name, peripheral] : byName_) {
    if (name != "SIM" && name != "MCG") {
      peripheral->reset(cause);
    }
  }
  for (unsigned i = 0; i < kPorts; ++i) {
    gpios_[i].reset(cause);
    ports_[i].settle();
  }
  pitGate_ = false;
  renewAll();
  cpu_.reset();
  // After a reset, PTA4 is the input of the NMI. If the pin is low, the NMI is requested at once.
  if (!pins_[0].seen(kNmiPin)) {
    raiseNmi();
  }
  ++resets;
  if (recorder != nullptr) {
    recorder->reset();
  }
  tell(Event::Kind::Reset, static_cast<std::uint32_t>(cause), 0);
}

void VirtualBoard::Parts::requestReset(Reset cause, std::string id, std::string what) {
  if (debugs_) {
    debugRefused_ = true;
  } else if (options_.resetsAreFindings) {
    report(std::move(id), std::move(what));
  } else {
    wantedReset_ = cause;
    cpu_.stop();
  }
}

void VirtualBoard::Parts::clocksChanged() {
  const Sim::Dividers dividers = sim_.dividers();
  const std::uint64_t output = mcg_.outputHz();
  if (core_.hz() == output / dividers.core && bus_.hz() == output / dividers.bus) {
    checkClocks();
    return;
  }
  const Time changed = time();
  standsAt_ = changed;
  core_.set(changed, output / dividers.core);
  bus_.set(changed, output / dividers.bus);
  knownCycle_ = cpu_.cycles();
  knownTime_ = changed;
  renewAll();
  checkClocks();
  cpu_.stop();  // the next events were computed with the old frequencies
}

void VirtualBoard::Parts::checkClocks() {
  // Checks the limits of the clocks. Each bus clock must be the core clock divided by an integer.
  // See data sheet K64P144M120SF5, device clock specifications, and K64P144M120SF5RM, chapter Clock
  // Distribution.
  const Sim::Dividers dividers = sim_.dividers();
  const std::uint64_t output = mcg_.outputHz();
  const auto check = [this, output](const char* name, unsigned divider, std::uint64_t most) {
    if (output / divider > most) {
      report("register-misuse", std::string(name) + " clock at " + megahertz(output / divider) +
                                    ", more than " + megahertz(most));
    }
  };
  check("core", dividers.core, 120'000'000);
  check("bus", dividers.bus, 60'000'000);
  check("FlexBus", dividers.flexBus, 50'000'000);
  check("flash", dividers.flash, 25'000'000);
  if (dividers.bus % dividers.core != 0 || dividers.flash % dividers.core != 0) {
    report("register-misuse",
           "SIM_CLKDIV1 selects a bus clock that is not the core clock divided by an integer");
  }
}

Peripheral* VirtualBoard::Parts::peripheralAt(std::uint32_t address, std::uint32_t& offset,
                                              bool store) {
  const auto access = [store](const std::string& place) {
    return (store ? "store to " : "load from ") + place;
  };
  if (address >= kGpio) {
    const std::uint32_t port = (address - kGpio) / kGpioSize;
    offset = (address - kGpio) % kGpioSize;
    if (port < kPorts) {
      return &gpios_[port];
    }
    refuse("unmapped-memory", access(hexText(address)));
    return nullptr;
  }
  const Place& place = places_[(address - kPeripherals) / kBlockSize];
  if (place.block == nullptr) {
    refuse("unmodelled-register", access(hexText(address)));
    return nullptr;
  }
  offset = address - place.block->base;
  if (place.block->gateGroup != 0 &&
      !sim_.gateIsOpen(place.block->gateGroup, place.block->gateBit)) {
    refuse("clock-gate", access(std::string(place.block->name) + " + " + hexText(offset)) +
                             " while its clock gate is closed");
    return nullptr;
  }
  if (place.peripheral == nullptr) {
    report(std::string(kUnmodelled), std::string(place.block->name) + " has no model");
  }
  return place.peripheral;
}

std::uint32_t VirtualBoard::Parts::read(std::uint32_t address, unsigned size) {
  access_ = Access{.address = address, .store = false};
  const std::uint32_t value = load(address, size);
  access_.reset();
  return value;
}

// A debugger can read a register only if reading has no side effect.
bool VirtualBoard::Parts::debugRead(std::uint32_t address, unsigned size, std::uint32_t& value) {
  debugs_ = true;
  debugRefused_ = false;
  std::uint32_t offset = 0;
  Peripheral* peripheral = peripheralAt(address, offset, false);
  const bool readable = peripheral != nullptr && !peripheral->readHasEffect(offset);
  if (readable) {
    value = peripheral->read(offset, size);
  }
  debugs_ = false;
  return readable && !debugRefused_;
}

bool VirtualBoard::Parts::debugWrite(std::uint32_t address, unsigned size, std::uint32_t value) {
  debugs_ = true;
  debugRefused_ = false;
  store(address, size, value);
  debugs_ = false;
  return !debugRefused_;
}

std::uint32_t VirtualBoard::Parts::load(std::uint32_t address, unsigned size) {
  std::uint32_t offset = 0;
  Peripheral* peripheral = peripheralAt(address, offset, false);
  if (peripheral == nullptr) {
    return 0;
  }
  if (peripheral->due() <= time()) {
    peripheral->advance();
  }
  const std::uint32_t value = peripheral->read(offset, size);
  peripheral->renewDue();
  return value;
}

void VirtualBoard::Parts::write(std::uint32_t address, unsigned size, std::uint32_t value) {
  if (written) {
    written(address, size, value);
  }
  access_ = Access{.address = address, .store = true};
  store(address, size, value);
  access_.reset();
}

void VirtualBoard::Parts::store(std::uint32_t address, unsigned size, std::uint32_t value) {
  std::uint32_t offset = 0;
  Peripheral* peripheral = peripheralAt(address, offset, true);
  if (peripheral == nullptr) {
    return;
  }
  if (peripheral->due() <= time()) {
    peripheral->advance();
  }
  peripheral->write(offset, size, value);
  if (peripheral == &sim_) {
    gatesChanged();
  } else if (peripheral >= ports_.data() && peripheral < ports_.data() + kPorts) {
    std::ranges::for_each(ftms_, &Ftm::show);
  }
  renew(*peripheral);
}

// Updates the time of the next event of a peripheral. The core stops at this time at the latest.
void VirtualBoard::Parts::renew(Peripheral& peripheral) {
  peripheral.renewDue();
  limitTo(peripheral.due());
}

void VirtualBoard::Parts::limitTo(Time time) {
  if (time != kNever && core_.hz() != 0) {
    cpu_.limitTo(core_.reach(time));
  }
}

void VirtualBoard::Parts::renewAll() {
  std::ranges::for_each(timed_, &Peripheral::renewDue);
}

void VirtualBoard::Parts::gatesChanged() {
  constexpr unsigned kPitGroup = 6;
  constexpr unsigned kPitBit = 23;
  if (const bool open = sim_.gateIsOpen(kPitGroup, kPitBit);
      open != std::exchange(pitGate_, open)) {
    pit_.gateOpened();
  }
  constexpr std::array<std::pair<unsigned, unsigned>, kTimers> kTimerGates{
      {{6, 24}, {6, 25}, {6, 26}, {3, 25}}};
  for (unsigned i = 0; i < kTimers; ++i) {
    if (ftms_[i].counts() && !sim_.gateIsOpen(kTimerGates[i].first, kTimerGates[i].second)) {
      report("register-misuse",
             "the clock gate of FTM" + std::to_string(i) +
                 " was closed while its counter ran; its pins keep their levels");
    }
  }
}

Time VirtualBoard::Parts::nextEvent() const {
  Time next = agenda_.next();
  for (const Peripheral* peripheral : timed_) {
    next = std::min(next, peripheral->due());
  }
  return next;
}

void VirtualBoard::Parts::advance() {
  const Time now = time();
  agenda_.advance(now);
  for (Peripheral* peripheral : timed_) {
    if (peripheral->due() <= now) {
      peripheral->advance();
      peripheral->renewDue();
    }
  }
}

// Advances the core to a time. The core runs, sleeps, or has no clock. Returns false if a problem
// has stopped the program.
bool VirtualBoard::Parts::runCore(Time until) {
  if (core_.hz() == 0) {
    standsAt_ = until;
    return true;
  }
  const std::uint64_t limit = core_.reach(until);
  const CortexM4::Stop stop = cpu_.run(limit);
  sleeps_ = stop == CortexM4::Stop::Sleep;
  return stop != CortexM4::Stop::Problem;
}

void VirtualBoard::Parts::setLine(unsigned line, bool high) {
  const bool rises = high && !lines_[line];
  lines_.set(line, high);
  if (rises) {
    tell(Event::Kind::LineRaised, kFirstLine + line, 0);
  }
  cpu_.setLine(line, high && !held_[line]);
}

void VirtualBoard::Parts::hold(unsigned line, bool held) {
  held_.set(line, held);
  cpu_.setLine(line, lines_[line] && !held);
}

void VirtualBoard::Parts::report(std::string id, std::string what) {
  if (debugs_) {
    debugRefused_ = true;
    return;
  }
  if (id != kUnmodelled) {
    cpu_.report(std::move(id), std::move(what));
    return;
  }
  if (access_) {
    const std::string name = registerName(access_->address);
    what += (access_->store ? " (store to " : " (load from ") + name + " at " +
            hexText(access_->address) + ")";
  }
  if (!warn(what)) {
    cpu_.report(std::move(id), std::move(what));
  }
}

// Adds a warning about an access that is not modelled. Returns false if such accesses are findings.
bool VirtualBoard::Parts::warn(const std::string& what) {
  if (options_.unmodelledIsFinding) {
    return false;
  }
  if (warned_.insert(what).second) {
    warnings.push_back(findingOf({std::string(kUnmodelled), what, cpu_.pc()}));
  }
  return true;
}

Finding VirtualBoard::Parts::findingOf(const CortexM4::Problem& problem) const {
  Finding found{problem.id, problem.what, problem.pc, {}, {}, now()};
  if (!options_.elf.empty()) {
    locate(found, options_.elf);
  }
  return found;
}

template <typename Done>
bool VirtualBoard::Parts::runUntil(Time limit, Done done) {
  while (!finding) {
    if (cpu_.problem()) {
      finding = findingOf(*cpu_.problem());
      break;
    }
    if (wantedReset_) {
      resetNow(*wantedReset_);
      continue;
    }
    if (done()) {
      return true;
    }
    if (time() >= limit) {
      return false;
    }
    const Time next = std::min(nextEvent(), limit);
    if (next > time() && runCore(next) && sleeps_ && core_.hz() != 0 && !done()) {
      // The program may have caused an event that is earlier than the time `next`.
      const std::uint64_t before = cpu_.cycles();
      cpu_.skipTo(core_.reach(std::min(nextEvent(), limit)));
      sleptCycles_ += cpu_.cycles() - before;
    }
    advance();
  }
  return false;
}

void VirtualBoard::Parts::drive(char name, unsigned pin, bool level) {
  PinState& pins = port(name);
  pins.driven |= 1U << pin;
  pins.outside = (pins.outside & ~(1U << pin)) | (level ? 1U << pin : 0);
  Port& settled = ports_[static_cast<std::size_t>(name - 'A')];
  settled.settle(1U << pin);
  renew(settled);
}

VirtualBoard::VirtualBoard(std::vector<std::uint8_t> image, Options options)
    : parts_(std::make_unique<Parts>(std::move(image), std::move(options))) {}

VirtualBoard::~VirtualBoard() = default;

bool VirtualBoard::runUntil(nanoseconds time) {
  parts_->runUntil(time, [] { return false; });
  return !parts_->finding;
}

bool VirtualBoard::runToInterrupt(int irq, nanoseconds limit) {
  parts_->awaited = kFirstLine + static_cast<unsigned>(irq);
  parts_->awaitedCame = false;
  const bool came = parts_->runUntil(limit, [this] { return parts_->awaitedCame; });
  parts_->awaited = 0;
  return came;
}

bool VirtualBoard::runToSleep(nanoseconds limit) {
  return parts_->runUntil(limit, [this] { return parts_->sleeps(); });
}

VirtualBoard::nanoseconds VirtualBoard::now() const {
  return parts_->now();
}

const std::optional<Finding>& VirtualBoard::finding() const {
  return parts_->finding;
}

std::vector<Finding> VirtualBoard::takeWarnings() {
  return std::exchange(parts_->warnings, {});
}

void VirtualBoard::receive(std::span<const std::uint8_t> bytes) {
  receiveOn(0, bytes);
}

void VirtualBoard::receiveAt(nanoseconds time, std::span<const std::uint8_t> bytes) {
  Uart& uart = parts_->uart(0);
  for (const std::uint8_t byte : bytes) {
    uart.arrive(std::max<Time>(time, parts_->time()), byte);
  }
  parts_->renew(uart);
}

void VirtualBoard::receiveBroken(std::uint8_t byte) {
  Uart& uart = parts_->uart(0);
  uart.arrive(parts_->time(), byte, false);
  parts_->renew(uart);
}

void VirtualBoard::setLineBaud(std::uint32_t baud) {
  setLineBaudOn(0, baud);
}

std::vector<std::uint8_t> VirtualBoard::takeSent() {
  return takeSentOn(0);
}

void VirtualBoard::receiveOn(int uart, std::span<const std::uint8_t> bytes) {
  Uart& line = parts_->uart(uart);
  for (const std::uint8_t byte : bytes) {
    line.arrive(parts_->time(), byte);
  }
  parts_->renew(line);
}

std::vector<std::uint8_t> VirtualBoard::takeSentOn(int uart) {
  return parts_->uart(uart).takeSent();
}

void VirtualBoard::setLineBaudOn(int uart, std::uint32_t baud) {
  parts_->uart(uart).setLineBaud(baud);
}

void VirtualBoard::receiveCan(CanFrame frame) {
  parts_->can().arrive(std::move(frame));
  parts_->renew(parts_->can());
}

std::vector<CanFrame> VirtualBoard::takeSentCan() {
  return parts_->can().takeSent();
}

bool VirtualBoard::canIdle() const {
  return parts_->can().idle();
}

bool VirtualBoard::lineIdle() const {
  return parts_->uart(0).lineIdle();
}

bool VirtualBoard::pin(char port, int number) const {
  return parts_->port(port).level(static_cast<unsigned>(number));
}

void VirtualBoard::drive(char port, int number, bool level) {
  parts_->drive(port, static_cast<unsigned>(number), level);
}

void VirtualBoard::driveAt(nanoseconds time, char port, int number, bool level) {
  const Time at = std::max<Time>(time, parts_->time());
  parts_->agenda().add({at, port, static_cast<unsigned>(number), level});
  parts_->limitTo(at);
}

double VirtualBoard::pwmDuty(int ftm, int channel) const {
  return parts_->ftm(ftm).duty(static_cast<unsigned>(channel));
}

void VirtualBoard::setAnalog(int converter, int channel, double volts) {
  parts_->adc(converter).setVolts(static_cast<unsigned>(channel), volts);
}

void VirtualBoard::openAnalog(int converter, int channel) {
  parts_->adc(converter).open(static_cast<unsigned>(channel));
}

void VirtualBoard::onTime(nanoseconds period, std::function<void()> call) {
  parts_->agenda().every(period, parts_->time(), std::move(call));
  parts_->limitTo(parts_->agenda().next());
}

bool VirtualBoard::isOutput(char port, int number) const {
  return parts_->port(port).isOutput(static_cast<unsigned>(number));
}

void VirtualBoard::raise(int exception) {
  parts_->cpu().raise(static_cast<unsigned>(exception));
}

void VirtualBoard::flipBit(std::uint32_t address, unsigned bit) {
  const std::uint32_t byte = parts_->cpu().word(address & ~3U) >> 8 * (address & 3U);
  const std::array flipped{static_cast<std::uint8_t>(byte ^ 1U << bit)};
  parts_->cpu().load(address, flipped);
}

std::uint32_t VirtualBoard::core(unsigned number) const {
  return parts_->cpu().core(number);
}

void VirtualBoard::setCore(unsigned number, std::uint32_t value) {
  parts_->cpu().setCore(number, value);
}

void VirtualBoard::holdInterrupt(int irq, bool held) {
  parts_->hold(static_cast<unsigned>(irq), held);
}

void VirtualBoard::setExternalClock(bool present) {
  parts_->mcg().setExternalClock(present);
  parts_->renew(parts_->mcg());
}

void VirtualBoard::loseLock() {
  parts_->mcg().loseLock();
  parts_->renew(parts_->mcg());
}

void VirtualBoard::endClockFailure() {
  parts_->mcg().endFailure();
}

void VirtualBoard::reset(Reset cause) {
  parts_->resetNow(cause);
}

int VirtualBoard::resets() const {
  return parts_->resets;
}

std::uint64_t VirtualBoard::instructions() const {
  return parts_->cpu().instructions();
}

std::uint64_t VirtualBoard::cycles() const {
  return parts_->cpu().cycles();
}

std::uint64_t VirtualBoard::sleptCycles() const {
  return parts_->sleptCycles();
}

unsigned VirtualBoard::priority(unsigned exception) const {
  return static_cast<unsigned>(parts_->cpu().priority(exception)) >> 4U;
}

std::uint32_t VirtualBoard::clockHz() const {
  return static_cast<std::uint32_t>(parts_->core().hz());
}

std::uint32_t VirtualBoard::word(std::uint32_t address) const {
  return parts_->cpu().word(address);
}

void VirtualBoard::onEvent(std::function<void(const Event&)> call) {
  parts_->event = std::move(call);
}

void VirtualBoard::onWrite(std::function<void(std::uint32_t, unsigned, std::uint32_t)> call) {
  parts_->written = std::move(call);
}

DebugPort& VirtualBoard::debugPort() {
  return parts_->debugPort();
}

void VirtualBoard::record(CallRecorder& recorder) {
  parts_->recorder = &recorder;
  parts_->cpu().onBlock([this](std::uint32_t address) {
    const CortexM4& cpu = parts_->cpu();
    parts_->recorder->block(address, cpu.core(13), cpu.core(14));
  });
}

void VirtualBoard::noteExecuted(ExecutedCode& code) {
  parts_->cpu().noteExecuted(code);
}

void VirtualBoard::noteStack(std::uint32_t& lowest) {
  parts_->cpu().noteStack(lowest);
}

}  // namespace wr::emulator
