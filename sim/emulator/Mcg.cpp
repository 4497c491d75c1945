#include "sim/emulator/Mcg.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace wr::emulator {

namespace {

using namespace std::chrono_literals;

// Offsets from 0x40064000 (K64P144M120SF5RM, MCG memory map).
constexpr std::uint32_t kC1 = 0x0;
constexpr std::uint32_t kC2 = 0x1;
constexpr std::uint32_t kC3 = 0x2;
constexpr std::uint32_t kC4 = 0x3;
constexpr std::uint32_t kC5 = 0x4;
constexpr std::uint32_t kC6 = 0x5;
constexpr std::uint32_t kS = 0x6;
constexpr std::uint32_t kSc = 0x8;
constexpr std::uint32_t kC7 = 0xC;
constexpr std::uint32_t kC8 = 0xD;

constexpr std::uint64_t kSlowInternalHz = 32'768;
constexpr std::uint64_t kFastInternalHz = 4'000'000;

// S.CLKST
constexpr unsigned kFromFll = 0;
constexpr unsigned kFromInternal = 1;
constexpr unsigned kFromExternal = 2;
constexpr unsigned kFromPll = 3;

// The duration of each change of a clock in the model of the clock generator. According to the
// manual, the real durations are at most a few cycles of the clocks that are involved.
constexpr Time kReferenceDelay = 60us;
constexpr Time kSwitchDelay = 5us;
constexpr Time kPllChosenDelay = 5us;

}  // namespace

void Mcg::reset(Reset /*cause*/) {
  c1_ = 0x04;
  c2_ = 0x80;
  c3_ = 0x80;
  c4_ = 0x10;
  c5_ = 0;
  c6_ = 0;
  c7_ = 0;
  c8_ = 0x80;
  sc_ = 0x02;
  reference_ = {.now = 1, .asked = 1};
  source_ = {};
  pllChosen_ = {};
  locked_ = {};
  lostLock_ = false;
  board_.clocksChanged();
}

Mcg::Mode Mcg::mode() const {
  const unsigned clks = c1_ >> 6;
  const bool internal = (c1_ & 0x04U) != 0;
  const bool pll = (c6_ & 0x40U) != 0;
  const bool low = (c2_ & 0x02U) != 0;
  switch (clks) {
    case 0:
      return pll ? (internal ? Mode::None : Mode::Pee) : (internal ? Mode::Fei : Mode::Fee);
    case 1:
      return !internal || pll ? Mode::None : (low ? Mode::Blpi : Mode::Fbi);
    case 2:
      return internal ? Mode::None : low ? Mode::Blpe : pll ? Mode::Pbe : Mode::Fbe;
    default:
      return Mode::None;
  }
}

// Returns true if the mode state diagram of K64P144M120SF5RM, chapter MCG, contains a change from
// the first mode to the second mode.
bool Mcg::leadsTo(Mode from, Mode to) {
  using enum Mode;
  constexpr std::array<std::pair<Mode, Mode>, 12> kNeighbours{{{Fei, Fee},
                                                               {Fei, Fbi},
                                                               {Fei, Fbe},
                                                               {Fee, Fbi},
                                                               {Fee, Fbe},
                                                               {Fbi, Fbe},
                                                               {Fbi, Blpi},
                                                               {Fbe, Pbe},
                                                               {Fbe, Blpe},
                                                               {Pbe, Blpe},
                                                               {Pbe, Pee},
                                                               {Fei, Fei}}};
  return from == to || std::ranges::any_of(kNeighbours, [from, to](const auto& pair) {
           return pair == std::pair(from, to) || pair == std::pair(to, from);
         });
}

bool Mcg::settled() const {
  return reference_.now == reference_.asked && source_.now == source_.asked &&
         pllChosen_.now == pllChosen_.asked;
}

unsigned Mcg::fllDivider() const {
  const unsigned setting = c1_ >> 3 & 7U;
  if ((c2_ >> 4 & 3U) == 0) {
    return 1U << setting;
  }
  return setting == 7 ? 1536 : setting == 6 ? 1280 : 32U << setting;
}

std::uint64_t Mcg::fllHz() const {
  constexpr std::array<std::uint64_t, 4> kFactors{640, 1280, 1920, 2560};
  constexpr std::array<std::uint64_t, 4> kFactorsFor32Khz{732, 1464, 2197, 2929};
  const std::uint64_t reference =
      reference_.now != 0 ? kSlowInternalHz : (external_ ? kExternalHz / fllDivider() : 0);
  const std::size_t range = c4_ >> 5 & 3U;
  return reference * ((c4_ & 0x80U) != 0 ? kFactorsFor32Khz : kFactors)[range];
}

std::uint64_t Mcg::pllReferenceHz() const {
  return external_ ? kExternalHz / ((c5_ & 0x1FU) + 1) : 0;
}

std::uint64_t Mcg::pllHz() const {
  return pllReferenceHz() * ((c6_ & 0x1FU) + 24);
}

bool Mcg::pllRuns() const {
  return ((c6_ & 0x40U) != 0 && (c2_ & 0x02U) == 0) || (c5_ & 0x40U) != 0;
}

std::uint64_t Mcg::outputHz() const {
  switch (source_.now) {
    case kFromFll:
      return fllHz();
    case kFromInternal:
      return (c2_ & 1U) != 0 ? kFastInternalHz >> (sc_ >> 1 & 7U) : kSlowInternalHz;
    case kFromExternal:
      return external_ ? kExternalHz : 0;
    default:
      return pllHz();
  }
}

std::uint32_t Mcg::status() const {
  return (c2_ & 1U) | source_.now << 2 | reference_.now << 4 | pllChosen_.now << 5 |
         locked_.now << 6 | (lostLock_ ? 0x80U : 0);
}

std::uint32_t Mcg::read(std::uint32_t offset, unsigned size) {
  if (!hasSize("MCG", offset, size, 1)) {
    return 0;
  }
  switch (offset) {
    case kC1:
      return c1_;
    case kC2:
      return c2_;
    case kC3:
      return c3_;
    case kC4:
      return c4_;
    case kC5:
      return c5_;
    case kC6:
      return c6_;
    case kS:
      return status();
    case kSc:
      return sc_;
    case kC7:
      return c7_;
    case kC8:
      return c8_;
    default:
      unmodelled("MCG", offset);
      return 0;
  }
}

void Mcg::write(std::uint32_t offset, unsigned size, std::uint32_t value) {
  if (!hasSize("MCG", offset, size, 1)) {
    return;
  }
  const Mode before = mode();
  const bool wasSettled = settled();
  const std::uint32_t c5Before = c5_;
  const std::uint32_t c6Before = c6_;
  switch (offset) {
    case kC1:
      c1_ = value;
      break;
    case kC2:
      c2_ = value;
      break;
    case kC3:
      c3_ = value;
      break;
    case kC4:
      c4_ = value;
      break;
    case kC5:
      c5_ = value;
      break;
    case kC6:
      c6_ = value;
      break;
    case kS:
      lostLock_ = lostLock_ && (value & 0x80U) == 0;  // LOLS0 is cleared by writing 1
      return;
    case kSc:
      sc_ = value;
      break;
    case kC7:
      c7_ = value;
      if ((value & 3U) != 0) {
        board_.report("unmodelled-register", "MCG_C7: only the system oscillator is modelled");
      }
      break;
    case kC8:
      c8_ = value;
      break;
    default:
      unmodelled("MCG", offset);
      return;
  }
  if (((c5_ ^ c5Before) & 0x1FU) != 0 || ((c6_ ^ c6Before) & 0x1FU) != 0) {
    if (source_.now == kFromPll) {
      misuse("the divider of the PLL was changed while the PLL was the clock");
    }
    locked_ = {};
  }
  checkChange(before, wasSettled);
  follow();
  board_.clocksChanged();
}

void Mcg::checkChange(Mode before, bool wasSettled) {
  const Mode after = mode();
  if (after == Mode::None || !leadsTo(before, after)) {
    misuse("the MCG state diagram does not contain the change of mode that the program requests");
  } else if (after != before && !wasSettled) {
    misuse("the program requests a change of the MCG mode before the previous change is complete");
  } else if (after == Mode::Pee && before == Mode::Pbe && locked_.now == 0) {
    misuse("the program selects the PLL as clock before the PLL is locked");
  }
  if (after != before && (after == Mode::Fbe || after == Mode::Fee)) {
    checkFllReference();
  }
  if (pllRuns()) {
    checkPll();
  }
}

void Mcg::checkFllReference() {
  // The reference of the FLL (C1.FRDIV) must be between 31.25 kHz and 39.0625 kHz.
  const std::uint64_t reference = kExternalHz / fllDivider();
  if (reference < 31'250 || reference > 39'062) {
    misuse("the reference clock of the FLL has " + std::to_string(reference) +
           " Hz, not 31250 Hz to 39062 Hz");
  }
}

void Mcg::checkPll() {
  // The reference of the PLL (C5.PRDIV0) must be between 2 MHz and 4 MHz. The output of the PLL is
  // at most 120 MHz (data sheet K64P144M120SF5, PLL).
  const std::uint64_t reference = kExternalHz / ((c5_ & 0x1FU) + 1);
  const std::uint64_t output = reference * ((c6_ & 0x1FU) + 24);
  if (reference < 2'000'000 || reference > 4'000'000) {
    misuse("the reference clock of the PLL has " + std::to_string(reference) +
           " Hz, not 2 MHz to 4 MHz");
  } else if (output > 120'000'000) {
    misuse("the output of the PLL has " + std::to_string(output) + " Hz, more than 120 MHz");
  }
}

void Mcg::follow() {
  const Time now = board_.time();
  const bool wantsInternal = (c1_ & 0x04U) != 0;
  const bool oscillator = (c2_ & 0x04U) != 0;  // EREFS selects a crystal, which the board lacks
  const bool externalUsable = external_ && !oscillator;
  reference_.ask(wantsInternal ? 1 : 0,
                 wantsInternal || externalUsable ? now + kReferenceDelay : kNever);
  pllChosen_.ask((c6_ & 0x40U) != 0 ? 1 : 0, now + kPllChosenDelay);

  if (pllRuns() && externalUsable) {
    // The lock time is 150 us plus 1075 periods of the reference (data sheet K64P144M120SF5, PLL).
    const auto periods = static_cast<std::int64_t>(1075 * 1'000'000'000'000 / pllReferenceHz());
    locked_.ask(1, failingStep_ == 3 ? kNever : now + 150us + Time(periods));
  } else {
    if (locked_.now != 0 && pllRuns()) {
      lockIsLost();
    }
    locked_ = {};
  }

  const unsigned clks = c1_ >> 6;
  const unsigned wanted = clks == 0 ? (pllChosen_.now != 0 ? kFromPll : kFromFll) : clks;
  const bool usable = wanted == kFromExternal ? externalUsable && failingStep_ != 2
                      : wanted == kFromPll    ? locked_.now != 0 && failingStep_ != 4
                                              : true;
  source_.ask(wanted, usable ? now + kSwitchDelay : kNever);
}

Time Mcg::nextEvent() const {
  return std::min({reference_.due, source_.due, pllChosen_.due, locked_.due});
}

void Mcg::advance() {
  const Time now = board_.time();
  if (nextEvent() > now) {
    return;
  }
  reference_.settle(now);
  source_.settle(now);
  pllChosen_.settle(now);
  locked_.settle(now);
  follow();
  board_.clocksChanged();
}

void Mcg::lockIsLost() {
  lostLock_ = true;
  // With C8.LOLRE, the loss of the lock causes a reset.
  if ((c8_ & 0x40U) != 0) {
    board_.requestReset(Reset::LockLost, "reset-request", "the PLL lost its lock");
  }
}

void Mcg::loseLock() {
  locked_ = {};
  lockIsLost();
  follow();
}

void Mcg::setExternalClock(bool present) {
  const bool lost = external_ && !present;
  external_ = present;
  // With C6.CME0 and C2.LOCRE0, the loss of the clock causes a reset.
  if (lost && (c6_ & 0x20U) != 0 && (c2_ & 0x80U) != 0) {
    board_.requestReset(Reset::ClockLost, "reset-request", "the external clock was lost");
    return;
  }
  follow();
  board_.clocksChanged();
}

}  // namespace wr::emulator
