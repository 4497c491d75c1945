#include "sim/emulator/Wdog.hpp"

#include <algorithm>

#include "sim/emulator/hexText.hpp"

namespace wr::emulator {

namespace {

// Offsets from 0x40052000 (K64P144M120SF5RM, WDOG memory map).
constexpr std::uint32_t kStctrlh = 0x0;
constexpr std::uint32_t kStctrll = 0x2;
constexpr std::uint32_t kTovalh = 0x4;
constexpr std::uint32_t kTovall = 0x6;
constexpr std::uint32_t kWinh = 0x8;
constexpr std::uint32_t kWinl = 0xA;
constexpr std::uint32_t kRefresh = 0xC;
constexpr std::uint32_t kUnlock = 0xE;
constexpr std::uint32_t kTmrouth = 0x10;
constexpr std::uint32_t kTmroutl = 0x12;
constexpr std::uint32_t kRstcnt = 0x14;
constexpr std::uint32_t kPresc = 0x16;

// STCTRLH
constexpr std::uint16_t kAlternateClock = 1U << 1;
constexpr std::uint16_t kInterruptFirst = 1U << 2;
constexpr std::uint16_t kWindow = 1U << 3;
constexpr std::uint16_t kAllowUpdate = 1U << 4;
constexpr std::uint16_t kRunsInWait = 1U << 7;
constexpr std::uint16_t kTest = 1U << 10;

// See "The values for N and K" in K20 Sub-Family Reference Manual, chapter 23. The K20 has the same
// module.
constexpr std::uint64_t kConfigurationTime = 256;
constexpr std::uint64_t kKeyTime = 20;

constexpr std::uint64_t kOscillatorHz = 1000;
constexpr unsigned kInterruptLine = 22;

constexpr std::array<std::uint16_t, 12> kAtReset{0x01D3, 0x0001, 0x004C, 0x4B4C, 0x0000, 0x0010,
                                                 0xB480, 0xD928, 0x0000, 0x0000, 0x0000, 0x0400};

}  // namespace

void Wdog::reset(Reset cause) {
  resets_ = cause == Reset::PowerOn    ? std::uint16_t{0}
            : cause == Reset::Watchdog ? static_cast<std::uint16_t>(resets_ + 1)
                                       : resets_;
  registers_ = kAtReset;
  registers_[kRstcnt / 2] = resets_;
  oscillator_.set(board_.time(), kOscillatorHz);
  lock_ = Lock::FreshlyReset;
  lockChanged_ = bus();
  configured_ = false;
  unlockKeyAt_.reset();
  refreshKeyAt_.reset();
  resetAt_.reset();
  board_.setLine(kInterruptLine, false);
  restart();
}

const Clock& Wdog::source() const {
  return (registers_[kStctrlh / 2] & kAlternateClock) != 0 ? board_.busClock() : oscillator_;
}

std::uint64_t Wdog::divider() const {
  return (registers_[kPresc / 2] >> 8 & 7U) + 1U;
}

std::uint32_t Wdog::timeOut() const {
  return static_cast<std::uint32_t>(registers_[kTovalh / 2]) << 16 | registers_[kTovall / 2];
}

std::uint64_t Wdog::timer() const {
  return counts() ? (source().count(board_.time()) - countsFrom_) / divider() : 0;
}

void Wdog::restart() {
  countsFrom_ = source().count(board_.time());
}

void Wdog::fail(std::string id, std::string what) {
  if ((registers_[kStctrlh / 2] & kInterruptFirst) != 0 && !resetAt_) {
    registers_[kStctrll / 2] |= 0x8000U;
    board_.setLine(kInterruptLine, true);
    resetAt_ = bus() + kConfigurationTime;
    return;
  }
  board_.requestReset(Reset::Watchdog, std::move(id), std::move(what));
}

std::uint32_t Wdog::read(std::uint32_t offset, unsigned size) {
  if (offset > kPresc) {
    unmodelled("WDOG", offset);
    return 0;
  }
  if (!hasSize("WDOG", offset, size, 2)) {
    return 0;
  }
  if (offset == kTmrouth || offset == kTmroutl) {
    return (timer() >> (offset == kTmrouth ? 16U : 0U)) & 0xFFFFU;
  }
  return registers_[offset / 2];
}

void Wdog::write(std::uint32_t offset, unsigned size, std::uint32_t value) {
  if (offset > kPresc) {
    unmodelled("WDOG", offset);
    return;
  }
  if (!hasSize("WDOG", offset, size, 2)) {
    return;
  }
  switch (offset) {
    case kUnlock:
      unlock(value);
      break;
    case kRefresh:
      refresh(value);
      break;
    case kStctrll:
      if ((value & 0x8000U) != 0) {
        registers_[kStctrll / 2] &= 0x7FFFU;
        board_.setLine(kInterruptLine, false);
      }
      break;
    case kRstcnt:
      resets_ &= static_cast<std::uint16_t>(~value);
      registers_[kRstcnt / 2] = resets_;
      break;
    case kTmrouth:
    case kTmroutl:
      misuse("store to the timer of the watchdog");
      break;
    default:
      configure(offset, value);
      break;
  }
}

void Wdog::unlock(std::uint32_t key) {
  constexpr std::uint32_t kFirst = 0xC520;
  constexpr std::uint32_t kSecond = 0xD928;
  const std::uint64_t now = bus();
  if (key == kFirst) {
    unlockKeyAt_ = now;
    return;
  }
  const bool inTime = unlockKeyAt_ && now - *unlockKeyAt_ <= kKeyTime;
  if (key != kSecond || !inTime) {
    fail("watchdog-sequence",
         key != kSecond ? "unlock with the key " + hexText(key)
         : unlockKeyAt_ ? "the second key of the unlock is too late"
                        : "the second key of the unlock was written without the first key");
    return;
  }
  unlockKeyAt_.reset();
  if (lock_ == Lock::Locked && (registers_[kStctrlh / 2] & kAllowUpdate) == 0) {
    misuse("the watchdog was unlocked, although its configuration allows no update");
    return;
  }
  if (lock_ != Lock::Open) {  // an unlock has no effect within the configuration time
    lock_ = Lock::Open;
    lockChanged_ = now;
    written_ = 0;
  }
}

void Wdog::configure(std::uint32_t offset, std::uint32_t value) {
  const std::uint64_t now = bus();
  const std::uint32_t place = 1U << offset / 2;
  if (lock_ != Lock::Open) {
    board_.refuse("watchdog-sequence", "the watchdog was configured without unlock");
  } else if (now - lockChanged_ < 2) {
    board_.refuse("watchdog-sequence",
                  "the watchdog was configured in the bus clock cycle directly after its unlock");
  } else if ((written_ & place) != 0) {
    misuse("a register of the watchdog was written twice after one unlock");
  } else {
    written_ |= place;
    registers_[offset / 2] = static_cast<std::uint16_t>(value);
    if (offset == kStctrlh && (value & kTest) != 0) {
      unmodelled("WDOG_STCTRLH with TESTWDOG", offset);
    }
    restart();
  }
}

void Wdog::refresh(std::uint32_t key) {
  constexpr std::uint32_t kFirst = 0xA602;
  constexpr std::uint32_t kSecond = 0xB480;
  const std::uint64_t now = bus();
  if (key == kFirst) {
    refreshKeyAt_ = now;
    return;
  }
  const bool inTime = refreshKeyAt_ && now - *refreshKeyAt_ <= kKeyTime;
  if (key != kSecond || !inTime) {
    fail("watchdog-sequence",
         key != kSecond  ? "refresh with the key " + hexText(key)
         : refreshKeyAt_ ? "the second key of the refresh is too late"
                         : "the second key of the refresh was written without the first key");
    return;
  }
  refreshKeyAt_.reset();
  if (unlockKeyAt_ || lock_ == Lock::Open) {
    return;  // from the unlock to the end of the configuration time, a refresh has no effect
  }
  const std::uint32_t window =
      static_cast<std::uint32_t>(registers_[kWinh / 2]) << 16 | registers_[kWinl / 2];
  if (counts() && (registers_[kStctrlh / 2] & kWindow) != 0 && timer() < window) {
    fail("watchdog-early", "the watchdog was refreshed before its window");
    return;
  }
  restart();
}

void Wdog::checkConfiguration() {
  // The time-out must be longer than 2 * kConfigurationTime + 20 bus clocks (K20 Sub-Family
  // Reference Manual, 23.9).
  const Time unit = source().at(countsFrom_ + divider() * timeOut()) - source().at(countsFrom_);
  const Clock& clock = board_.busClock();
  const Time least = clock.at(bus() + 2 * kConfigurationTime + kKeyTime) - clock.at(bus());
  if (counts() && unit <= least) {
    misuse("the time-out of the watchdog is too short");
  }
  if (counts() && (registers_[kStctrlh / 2] & kRunsInWait) == 0) {
    unmodelled("WDOG_STCTRLH without WAITEN", kStctrlh);
  }
}

// Ends the configuration time. The written values take effect.
void Wdog::close() {
  lock_ = Lock::Locked;
  if (written_ == 0) {
    fail("watchdog-sequence", "the watchdog was unlocked, but was not configured");
    return;
  }
  configured_ = true;
  restart();
  checkConfiguration();
}

Time Wdog::nextEvent() const {
  const Clock& clock = board_.busClock();
  Time next = kNever;
  if (lock_ != Lock::Locked) {
    next = clock.at(lockChanged_ + kConfigurationTime + 1);
  }
  if (resetAt_) {
    next = std::min(next, clock.at(*resetAt_));
  }
  if (counts() && lock_ != Lock::Open) {
    next = std::min(next, source().at(countsFrom_ + divider() * timeOut()));
  }
  return next;
}

void Wdog::advance() {
  const std::uint64_t now = bus();
  if (lock_ == Lock::FreshlyReset && now > lockChanged_ + kConfigurationTime) {
    // The first key must be written within the configuration time. The second key must follow
    // within kKeyTime after the first key.
    const bool keyGiven = unlockKeyAt_ && *unlockKeyAt_ <= lockChanged_ + kConfigurationTime;
    if (keyGiven && now <= *unlockKeyAt_ + kKeyTime) {
      lockChanged_ = *unlockKeyAt_ + kKeyTime - kConfigurationTime;
    } else {
      lock_ = Lock::Locked;
      fail("watchdog-sequence",
           "the watchdog was not unlocked within 256 bus clocks after the reset");
      return;
    }
  }
  if (lock_ == Lock::Open && now > lockChanged_ + kConfigurationTime) {
    close();
  }
  if (resetAt_ && now >= *resetAt_) {
    resetAt_.reset();
    board_.requestReset(Reset::Watchdog, "watchdog-missed",
                        "the watchdog resets the board after its interrupt");
  } else if (counts() && lock_ != Lock::Open && timer() >= timeOut()) {
    restart();
    fail("watchdog-missed", "the watchdog was not refreshed within its time-out");
  }
}

}  // namespace wr::emulator
