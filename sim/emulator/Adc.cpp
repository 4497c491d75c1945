#include "sim/emulator/Adc.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/emulator/hexText.hpp"

namespace wr::emulator {

namespace {

// Offsets from the base of a converter (K64P144M120SF5RM, ADC memory map).
constexpr std::uint32_t kSc1a = 0x00;
constexpr std::uint32_t kSc1b = 0x04;
constexpr std::uint32_t kCfg1 = 0x08;
constexpr std::uint32_t kCfg2 = 0x0C;
constexpr std::uint32_t kRa = 0x10;
constexpr std::uint32_t kRb = 0x14;
constexpr std::uint32_t kSc2 = 0x20;
constexpr std::uint32_t kSc3 = 0x24;
constexpr std::uint32_t kOfs = 0x28;
constexpr std::uint32_t kPg = 0x2C;
constexpr std::uint32_t kMg = 0x30;
constexpr std::uint32_t kClpd = 0x34;
constexpr std::uint32_t kClps = 0x38;
constexpr std::uint32_t kNothing = 0x50;
constexpr std::uint32_t kClmd = 0x54;
constexpr std::uint32_t kClms = 0x58;
constexpr std::uint32_t kEnd = 0x70;

// SC1
constexpr std::uint32_t kOff = 0x1F;  // ADCH
constexpr std::uint32_t kDifferential = 1U << 5;
constexpr std::uint32_t kInterrupt = 1U << 6;
constexpr std::uint32_t kComplete = 1U << 7;
// CFG2
constexpr std::uint32_t kFast = 1U << 2;     // ADHSC
constexpr std::uint32_t kInputsB = 1U << 4;  // MUXSEL
// SC2
constexpr std::uint32_t kActive = 1U << 7;
// SC3
constexpr std::uint32_t kAverages = 1U << 2;
constexpr std::uint32_t kFailed = 1U << 6;      // CALF
constexpr std::uint32_t kCalibrates = 1U << 7;  // CAL

constexpr unsigned kHighReference = 29;
constexpr unsigned kLowReference = 30;
constexpr double kReference = 3.3;

constexpr std::array<unsigned, 2> kLines{39, 73};

}  // namespace

Adc::Adc(Microcontroller& board, unsigned number, bool calibrates)
    : Peripheral(board),
      name_("ADC" + std::to_string(number)),
      line_(kLines.at(number)),
      calibrates_(calibrates) {
  volts_.fill(0.0);
}

void Adc::connectPins(std::function<Input(unsigned)> input) {
  input_ = std::move(input);
}

void Adc::reset(Reset /*cause*/) {
  words_ = {};
  at(kSc1a) = kOff;
  at(kSc1b) = kOff;
  at(kOfs) = 0x4;
  at(kPg) = 0x8200;
  at(kMg) = 0x8200;
  for (const std::uint32_t first : {kClpd, kClmd}) {
    constexpr std::array<std::uint32_t, 7> kResults{0x0A, 0x20, 0x200, 0x100, 0x80, 0x40, 0x20};
    for (std::uint32_t i = 0; i < kResults.size(); ++i) {
      at(first + 4 * i) = kResults[i];
    }
  }
  doing_ = Doing::Nothing;
  calibrated_ = false;
  update();
}

void Adc::update() {
  const std::uint32_t both = kInterrupt | kComplete;
  board_.setLine(line_, (at(kSc1a) & both) == both);
}

// Returns the number of bus clock cycles in one cycle of the conversion clock, ADCK. CFG1.ADIV
// divides the bus clock.
std::uint32_t Adc::busClocksOfClock() const {
  return 1U << (at(kCfg1) >> 5 & 3U);
}

// Returns the number of ADCK cycles of a conversion, without the additional 5 bus clock cycles
// (chapter ADC, section Sample time and total conversion time).
std::uint32_t Adc::clocksOfConversion() const {
  constexpr std::array<std::uint32_t, 4> kBase{17, 20, 20, 25};  // MODE: 8, 12, 10, 16 bits
  constexpr std::array<std::uint32_t, 4> kLong{20, 12, 6, 2};    // ADLSTS
  const bool longSample = (at(kCfg1) >> 4 & 1U) != 0;
  const std::uint32_t each = kBase[at(kCfg1) >> 2 & 3U] + (longSample ? kLong[at(kCfg2) & 3U] : 0) +
                             ((at(kCfg2) & kFast) != 0 ? 2 : 0);
  const std::uint32_t times = (at(kSc3) & kAverages) != 0 ? 4U << (at(kSc3) & 3U) : 1;
  return (longSample ? 3 : 5) + times * each;
}

// Returns the correct value of the register PG or MG: half the sum of six results of the
// calibration, with bit 15 set.
std::uint32_t Adc::gain(std::uint32_t firstResult) const {
  std::uint32_t sum = 0;
  for (std::uint32_t i = 0; i < 6; ++i) {
    sum += at(firstResult + 4 * i);
  }
  return sum / 2 | 0x8000U;
}

std::uint32_t Adc::measured(unsigned channel) {
  constexpr std::array<unsigned, 4> kBits{8, 12, 10, 16};
  const auto full = static_cast<double>(1U << kBits[at(kCfg1) >> 2 & 3U]);
  const double volts = channel == kHighReference  ? kReference
                       : channel == kLowReference ? 0
                                                  : volts_[channel].value_or(capacitor_);
  capacitor_ = volts;
  return static_cast<std::uint32_t>(
      std::clamp(std::floor(volts / kReference * full + 0.5), 0.0, full - 1));
}

void Adc::checkClock(std::uint64_t least, std::uint64_t most, const char* what) {
  const std::uint64_t hz = board_.busClock().hz() / busClocksOfClock();
  if (hz < least || hz > most) {
    misuse(name_ + " " + what + " with a clock of " + std::to_string(hz / 1000) + " kHz, not " +
           std::to_string(least / 1000) + " to " + std::to_string(most / 1000) + " kHz");
  }
}

void Adc::checkInput(unsigned channel) {
  if (channel == kHighReference || channel == kLowReference) {
    return;
  }
  const auto text = [this, channel] {
    return name_ + " converts channel " + std::to_string(channel);
  };
  if (channel >= volts_.size()) {
    unmodelled(text(), kSc1a);
    return;
  }
  if (channel >= 4 && channel <= 7 && (at(kCfg2) & kInputsB) == 0) {
    unmodelled(text() + ", input a", kSc1a);
    return;
  }
  const Input input = input_(channel);
  if (input == Input::None) {
    unmodelled(text() + ", which has no pin of its own", kSc1a);
  } else if (input == Input::Digital) {
    misuse(text() + ", whose pin is not analog");
  }
}

void Adc::begin(Doing doing, std::uint64_t busClocks) {
  doing_ = doing;
  endsAt_ = bus() + busClocks;
  at(kSc2) |= kActive;
}

// Writing SC1A ends the running conversion and starts a new conversion.
void Adc::start(std::uint32_t value) {
  doing_ = Doing::Nothing;
  at(kSc1a) = value & (kInterrupt | kOff);
  at(kSc2) &= ~kActive;
  update();
  const unsigned channel = value & kOff;
  if ((value & kDifferential) != 0) {
    unmodelled(name_ + "_SC1A with DIFF", kSc1a);
  }
  if (channel == kOff) {
    return;
  }
  constexpr std::uint32_t kSixteenBits = 0xC;  // CFG1.MODE
  if ((at(kCfg1) & kSixteenBits) == kSixteenBits) {
    checkClock(2'000'000, 12'000'000, "converts 16 bits");
  } else {
    checkClock(1'000'000, 18'000'000, "converts");
  }
  if (!calibrated_ || at(kPg) != gain(kClps) || at(kMg) != gain(kClms)) {
    misuse(name_ + " converts, but PG and MG do not contain the gains of a calibration");
  }
  checkInput(channel);
  sample_ = channel < volts_.size() || channel >= kHighReference ? measured(channel) : 0;
  begin(Doing::Converts, 5 + std::uint64_t{clocksOfConversion()} * busClocksOfClock());
}

void Adc::calibrate() {
  checkClock(1'000'000, 4'000'000, "calibrates");
  at(kSc1a) &= ~kComplete;
  update();
  // According to the manual, a calibration takes at most 14000 ADCK cycles and 100 bus clock
  // cycles.
  begin(Doing::Calibrates, 100 + std::uint64_t{14'000} * busClocksOfClock());
}

void Adc::finish() {
  if (std::exchange(doing_, Doing::Nothing) == Doing::Converts) {
    at(kRa) = sample_;
  } else {
    calibrated_ = calibrates_;
    at(kSc3) = (at(kSc3) & ~kCalibrates) | (calibrates_ ? 0 : kFailed);
    // These results differ slightly from the reset values of the registers.
    at(kClps) = 0x24;
    at(kClms) = 0x22;
  }
  at(kSc2) &= ~kActive;
  at(kSc1a) |= kComplete;
  update();
}

Time Adc::nextEvent() const {
  return doing_ == Doing::Nothing ? kNever : board_.busClock().at(endsAt_);
}

void Adc::advance() {
  if (doing_ != Doing::Nothing && bus() >= endsAt_) {
    finish();
  }
}

bool Adc::readHasEffect(std::uint32_t offset) const {
  return offset == kRa;
}

std::uint32_t Adc::read(std::uint32_t offset, unsigned size) {
  if (!hasSize(name_, offset, size, 4)) {
    return 0;
  }
  if (offset >= kEnd || offset == kNothing) {
    unmodelled(name_, offset);
    return 0;
  }
  if (offset == kRa) {
    at(kSc1a) &= ~kComplete;
    update();
  }
  return at(offset);
}

void Adc::setControl3(std::uint32_t value) {
  constexpr std::uint32_t kContinuous = 1U << 3;
  if ((value & kContinuous) != 0) {
    unmodelled(name_ + "_SC3 with ADCO", kSc3);
  }
  const std::uint32_t failed = at(kSc3) & ~value & kFailed;  // cleared by writing 1
  at(kSc3) = failed | (value & (kAverages | 3U));
  if ((value & kCalibrates) != 0) {
    at(kSc3) = (at(kSc3) & ~kFailed) | kCalibrates;
    calibrate();
  }
}

void Adc::write(std::uint32_t offset, unsigned size, std::uint32_t value) {
  if (!hasSize(name_, offset, size, 4)) {
    return;
  }
  if (offset >= kEnd || offset == kNothing) {
    unmodelled(name_, offset);
    return;
  }
  if (doing_ == Doing::Calibrates || (doing_ == Doing::Converts && offset != kSc1a)) {
    misuse(name_ + " + " + hexText(offset) + " was written while it " +
           (doing_ == Doing::Converts ? "converted" : "was calibrated"));
  }
  switch (offset) {
    case kSc1a:
      start(value);
      break;
    case kSc1b:
      if ((value & kOff) != kOff) {
        unmodelled(name_ + "_SC1B, which needs a hardware trigger", offset);
      }
      break;
    case kCfg1:
      // ADICLK 1 is half the bus clock on older microcontrollers, and an alternate clock on this
      // microcontroller.
      if ((value & 3U) != 0) {
        unmodelled(name_ + "_CFG1 with ADICLK " + std::to_string(value & 3U) +
                       ", which is not the bus clock",
                   offset);
      }
      at(kCfg1) = value & 0xFFU;
      break;
    case kCfg2:
      at(kCfg2) = value & 0x1FU;
      break;
    case kRa:
    case kRb:
      misuse("store to a result of " + name_);
      break;
    case kSc2:
      if ((value & 0x7FU) != 0) {
        unmodelled(name_ + "_SC2 with a trigger, a comparison, DMA or another reference", offset);
      }
      break;
    case kSc3:
      setControl3(value);
      break;
    default:
      at(offset) = value & 0xFFFFU;
      break;
  }
}

}  // namespace wr::emulator
