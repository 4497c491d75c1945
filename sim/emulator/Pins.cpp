#include "sim/emulator/Pins.hpp"

#include <algorithm>
#include <bit>

namespace wr::emulator {

namespace {

// Offsets from the base of a port (K64P144M120SF5RM, PORT memory map).
constexpr std::uint32_t kPcrEnd = 0x80;
constexpr std::uint32_t kGpclr = 0x80;
constexpr std::uint32_t kGpchr = 0x84;
constexpr std::uint32_t kIsfr = 0xA0;
constexpr std::uint32_t kDfer = 0xC0;
constexpr std::uint32_t kDfcr = 0xC4;
constexpr std::uint32_t kDfwr = 0xC8;

constexpr unsigned kPortWithFilters = 3;        // D
constexpr std::uint32_t kPinsOfFilters = 0xFF;  // the pins that have a filter
constexpr std::uint32_t kWidth = 0x1F;
constexpr std::uint64_t kClocksOfSynchronizer = 3;

constexpr std::uint32_t kFlag = 1U << 24;
constexpr std::uint32_t kLocked = 1U << 15;
constexpr std::uint32_t kFields = 0x000F8777;

constexpr unsigned kFirstLine = 59;

// Offsets from the base of a port's GPIO (K64P144M120SF5RM, GPIO memory map).
constexpr std::uint32_t kPdor = 0x00;
constexpr std::uint32_t kPsor = 0x04;
constexpr std::uint32_t kPcor = 0x08;
constexpr std::uint32_t kPtor = 0x0C;
constexpr std::uint32_t kPdir = 0x10;
constexpr std::uint32_t kPddr = 0x14;

constexpr unsigned kNmiPin = 4;  // PTA4, function 7

}  // namespace

void Port::reset(Reset /*cause*/) {
  pins_.control.fill(0);
  if (number_ == 0) {
    // After a reset, these pins belong to the debugger and to NMI (K64P144M120SF5RM, Signal
    // Multiplexing).
    pins_.control[0] = 0x0702;
    pins_.control[1] = 0x0703;
    pins_.control[2] = 0x0703;
    pins_.control[3] = 0x0703;
    pins_.control[4] = 0x0703;
  }
  filter_ = {};
  pins_.filters = 0;
  pins_.passed = 0;
  waiting_ = 0;
  flags_ = 0;
  before_ = 0;
  for (unsigned pin = 0; pin < 32; ++pin) {
    before_ |= pins_.seen(pin) ? 1U << pin : 0;
  }
  onLevel_ = 0;
  updateLine();
}

void Port::updateLine() {
  board_.setLine(kFirstLine + number_, flags_ != 0);
}

// A new level passes the filter after this level has lasted for the width of the filter plus the
// clock cycles of the synchronizer.
void Port::passLater(unsigned pin) {
  const std::uint32_t bit = 1U << pin;
  if ((pins_.filters & bit) == 0 || pins_.level(pin) == ((pins_.passed & bit) != 0)) {
    waiting_ &= ~bit;
  } else if ((waiting_ & bit) == 0) {
    waiting_ |= bit;
    passesAt_[pin] =
        board_.busClock().count(board_.time()) + (filter_[2] & kWidth) + kClocksOfSynchronizer;
  }
}

Time Port::nextEvent() const {
  Time next = kNever;
  for (std::uint32_t left = waiting_; left != 0; left &= left - 1) {
    const auto pin = static_cast<unsigned>(std::countr_zero(left));
    next = std::min(next, board_.busClock().at(passesAt_[pin]));
  }
  return next;
}

void Port::advance() {
  const std::uint64_t now = board_.busClock().count(board_.time());
  std::uint32_t changed = 0;
  for (std::uint32_t left = waiting_; left != 0; left &= left - 1) {
    const auto pin = static_cast<unsigned>(std::countr_zero(left));
    changed |= passesAt_[pin] <= now ? 1U << pin : 0;
  }
  waiting_ &= ~changed;
  pins_.passed ^= changed;
  if (changed != 0) {
    settle(changed);
  }
}

void Port::settlePin(unsigned pin) {
  const std::uint32_t bit = 1U << pin;
  passLater(pin);
  const bool high = pins_.seen(pin);
  const bool edge = high != ((before_ & bit) != 0);
  before_ = (before_ & ~bit) | (high ? bit : 0);
  const unsigned kind = pins_.control[pin] >> 16 & 0xFU;
  // PCR.IRQC
  const bool raised = (kind == 0x8 && !high) || (kind == 0x9 && edge && high) ||
                      (kind == 0xA && edge && !high) || (kind == 0xB && edge) ||
                      (kind == 0xC && high);
  flags_ |= raised && pins_.function(pin) != 0 ? bit : 0;
  if (kind >= 1 && kind <= 3) {
    unmodelled("DMA request of a PORT", 4 * pin);
  }
  const bool isOutput = pins_.isOutput(pin);
  const bool shown = (pins_.shown & bit) != 0;
  if (isOutput && (high != shown || (pins_.shownOutputs & bit) == 0)) {
    board_.tell(Event::Kind::PinChanged, 32 * number_ + pin, high ? 1 : 0);
    pins_.shown = (pins_.shown & ~bit) | (high ? bit : 0);
  }
  pins_.shownOutputs = (pins_.shownOutputs & ~bit) | (isOutput ? bit : 0);
  if (number_ == 0 && pin == kNmiPin && pins_.function(kNmiPin) == 7 && edge && !high) {
    board_.raiseNmi();
  }
}

void Port::settle(std::uint32_t which) {
  for (std::uint32_t left = which | onLevel_; left != 0; left &= left - 1) {
    settlePin(static_cast<unsigned>(std::countr_zero(left)));
  }
  updateLine();
}

std::uint32_t Port::read(std::uint32_t offset, unsigned size) {
  if (!hasSize("PORT", offset, size, 4)) {
    return 0;
  }
  if (offset < kPcrEnd) {
    const unsigned pin = offset / 4;
    return pins_.control[pin] | ((flags_ >> pin & 1U) != 0 ? kFlag : 0);
  }
  if (offset == kIsfr) {
    return flags_;
  }
  if (offset >= kDfer && offset <= kDfwr) {
    return filter_[(offset - kDfer) / 4];
  }
  if (offset != kGpclr && offset != kGpchr) {
    unmodelled("PORT", offset);
  }
  return 0;
}

void Port::setControl(unsigned pin, std::uint32_t value) {
  if ((pins_.control[pin] & kLocked) != 0) {
    misuse("store to the control register of a locked pin");
    return;
  }
  const bool was = pins_.function(pin) != 0;
  pins_.control[pin] = value & kFields;
  const std::uint32_t bit = 1U << pin;
  if (!was) {
    // When a pin becomes digital, the change of its level is not an edge.
    before_ = (before_ & ~bit) | (pins_.seen(pin) ? bit : 0);
  }
  const unsigned kind = pins_.control[pin] >> 16 & 0xFU;
  onLevel_ = (onLevel_ & ~bit) | (kind == 0x8 || kind == 0xC ? bit : 0);
}

// GPCLR and GPCHR write the lower halves of 16 control registers.
void Port::setMany(std::uint32_t value, unsigned from) {
  for (unsigned i = 0; i < 16; ++i) {
    if ((value >> (16 + i) & 1U) != 0) {
      setControl(from + i, (pins_.control[from + i] & 0xFFFF0000U) | (value & 0xFFFFU));
    }
  }
}

void Port::setFilter(std::uint32_t offset, std::uint32_t value) {
  if (value != 0 && (number_ != kPortWithFilters || offset == kDfcr)) {
    unmodelled("digital filter of a PORT", offset);
    return;
  }
  if (offset != kDfer && pins_.filters != 0) {
    misuse("the clock or the width of the digital filters was written while a filter was on");
    return;
  }
  filter_[(offset - kDfer) / 4] = value;
  if (offset == kDfer) {
    const std::uint32_t switchedOn = value & ~pins_.filters & kPinsOfFilters;
    pins_.filters = value & kPinsOfFilters;
    pins_.passed &= pins_.filters & ~switchedOn;
    settle(kPinsOfFilters);
  }
}

void Port::write(std::uint32_t offset, unsigned size, std::uint32_t value) {
  if (!hasSize("PORT", offset, size, 4)) {
    return;
  }
  if (offset < kPcrEnd) {
    const unsigned pin = offset / 4;
    if ((value & kFlag) != 0) {
      flags_ &= ~(1U << pin);
    }
    setControl(pin, value);
    settle(1U << pin);
  } else if (offset == kGpclr || offset == kGpchr) {
    setMany(value, offset == kGpclr ? 0 : 16);
    settle();
  } else if (offset == kIsfr) {
    flags_ &= ~value;
    settle(0);
  } else if (offset >= kDfer && offset <= kDfwr) {
    setFilter(offset, value);
  } else {
    unmodelled("PORT", offset);
  }
}

void Gpio::reset(Reset /*cause*/) {
  pins_.output = 0;
  pins_.direction = 0;
}

std::uint32_t Gpio::read(std::uint32_t offset, unsigned size) {
  if (!hasSize("GPIO", offset, size, 4)) {
    return 0;
  }
  switch (offset) {
    case kPdor:
      return pins_.output;
    case kPddr:
      return pins_.direction;
    case kPdir: {
      std::uint32_t levels = 0;
      for (unsigned pin = 0; pin < 32; ++pin) {
        // If a pin is not digital, its input reads as 0.
        levels |= pins_.seen(pin) ? 1U << pin : 0;
      }
      return levels;
    }
    case kPsor:
    case kPcor:
    case kPtor:
      return 0;
    default:
      unmodelled("GPIO", offset);
      return 0;
  }
}

void Gpio::write(std::uint32_t offset, unsigned size, std::uint32_t value) {
  if (!hasSize("GPIO", offset, size, 4)) {
    return;
  }
  const std::uint32_t outputs = pins_.output;
  const std::uint32_t direction = pins_.direction;
  switch (offset) {
    case kPdor:
      pins_.output = value;
      break;
    case kPsor:
      pins_.output |= value;
      break;
    case kPcor:
      pins_.output &= ~value;
      break;
    case kPtor:
      pins_.output ^= value;
      break;
    case kPddr:
      pins_.direction = value;
      break;
    case kPdir:
      misuse("store to the inputs of a GPIO");
      break;
    default:
      unmodelled("GPIO", offset);
      break;
  }
  port_.settle((outputs ^ pins_.output) | (direction ^ pins_.direction));
}

}  // namespace wr::emulator
