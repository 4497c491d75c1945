#include "sim/emulator/SystemControl.hpp"

#include <iterator>

#include "sim/emulator/Nvic.hpp"

namespace wr::emulator {

namespace {

constexpr std::uint32_t kSpace = 0xE000E000;

constexpr unsigned kPendSv = 14;
constexpr unsigned kSysTick = 15;

// Offsets from 0xE000E000 (ARMv7-M ARM, table B3-4 (SCB), B3-7 (SysTick)).
constexpr std::uint32_t kIctr = 0x004;
constexpr std::uint32_t kActlr = 0x008;
constexpr std::uint32_t kTickControl = 0x010;
constexpr std::uint32_t kTickReload = 0x014;
constexpr std::uint32_t kTickValue = 0x018;
constexpr std::uint32_t kTickCalibration = 0x01C;
constexpr std::uint32_t kCpuid = 0xD00;
constexpr std::uint32_t kIcsr = 0xD04;
constexpr std::uint32_t kVtor = 0xD08;
constexpr std::uint32_t kAircr = 0xD0C;
constexpr std::uint32_t kScr = 0xD10;
constexpr std::uint32_t kCcr = 0xD14;
constexpr std::uint32_t kShpr1 = 0xD18;
constexpr std::uint32_t kShprEnd = 0xD24;
constexpr std::uint32_t kShcsr = 0xD24;
constexpr std::uint32_t kCfsr = 0xD28;
constexpr std::uint32_t kHfsr = 0xD2C;
constexpr std::uint32_t kDfsr = 0xD30;
constexpr std::uint32_t kMmfar = 0xD34;
constexpr std::uint32_t kBfar = 0xD38;
constexpr std::uint32_t kAfsr = 0xD3C;
constexpr std::uint32_t kFeatures = 0xD40;
constexpr std::uint32_t kCpacr = 0xD88;
constexpr std::uint32_t kMpuType = 0xD90;
constexpr std::uint32_t kDhcsr = 0xDF0;
constexpr std::uint32_t kDemcr = 0xDFC;
constexpr std::uint32_t kFpccr = 0xF34;
constexpr std::uint32_t kFpcar = 0xF38;
constexpr std::uint32_t kFpdscr = 0xF3C;
constexpr std::uint32_t kMvfr0 = 0xF40;
constexpr std::uint32_t kMvfr1 = 0xF44;

// ARMv7-M ARM, C1.8.7 and C1.8.8.
constexpr std::uint32_t kDwtControl = 0xE0001000;  // CTRL
constexpr std::uint32_t kDwtCycles = 0xE0001004;   // CYCCNT

// Cortex-M4 TRM, 4.1, table of the system control registers.
constexpr std::uint32_t kIdFeatures[] = {0x00000030, 0x00000200, 0x00100000, 0,          0x00100030,
                                         0,          0x01000000, 0,          0x01101110, 0x02112000,
                                         0x21232231, 0x01111131, 0x01310132};

constexpr std::uint32_t kTickCounted = 1U << 16;

}  // namespace

void SystemControl::reset(std::uint64_t cycle) {
  vectors_ = 0;
  control_ = 0;
  configuration_ = 0x200;
  auxiliary_ = 0;
  faultStatus_ = 0;
  hardFaultStatus_ = 0;
  busAddress_ = 0;
  coprocessors_ = 0;
  fpContext_ = 0xC0000000;
  fpDefaults_ = 0;
  debug_ = 0;
  tickControl_ = 0;
  tickReload_ = 0;
  tickValue_ = 0;
  traceControl_ = 0;
  cyclesFrom_ = cycle;
  cyclesHeld_ = 0;
}

void SystemControl::noteBusAddress(std::uint32_t address) {
  busAddress_ = address;
  faultStatus_ |= 1U << 15;
}

std::uint32_t SystemControl::interruptState(unsigned running) const {
  // ARMv7-M ARM, B3.2.4
  const unsigned next = nvic_.first();
  const auto bit = [this](unsigned exception, unsigned place) {
    return nvic_.isPending(exception) ? 1U << place : 0U;
  };
  return bit(2, 31) | bit(kPendSv, 28) | bit(kSysTick, 26) | (next >= 16 ? 1U << 22 : 0U) |
         next << 12 | (nvic_.activeCount() <= 1 ? 1U << 11 : 0U) | running;
}

std::uint32_t SystemControl::handlerState() const {
  // ARMv7-M ARM, B3.2.13
  const auto active = [this](unsigned exception, unsigned place) {
    return nvic_.isActive(exception) ? 1U << place : 0U;
  };
  const auto pending = [this](unsigned exception, unsigned place) {
    return nvic_.isPending(exception) ? 1U << place : 0U;
  };
  const auto enabled = [this](unsigned exception, unsigned place) {
    return nvic_.isEnabled(exception) ? 1U << place : 0U;
  };
  return active(4, 0) | active(5, 1) | active(6, 3) | active(11, 7) | active(12, 8) |
         active(kPendSv, 10) | active(kSysTick, 11) | pending(6, 12) | pending(4, 13) |
         pending(5, 14) | pending(11, 15) | enabled(4, 16) | enabled(5, 17) | enabled(6, 18);
}

std::uint32_t SystemControl::readSysTick(std::uint32_t offset, std::uint64_t cycle) {
  switch (offset) {
    case kTickControl: {
      const std::uint32_t value = tickControl_;
      tickControl_ &= ~kTickCounted;
      return value;
    }
    case kTickReload:
      return tickReload_;
    case kTickValue:
      return (tickControl_ & 1U) != 0 && tickReload_ != 0
                 ? static_cast<std::uint32_t>(tickZeroAt_ - cycle)
                 : tickValue_;
    default:
      return 0x80000000;  // no reference clock
  }
}

bool SystemControl::read(std::uint32_t address, std::uint64_t cycle, unsigned running,
                         std::uint32_t& value) {
  if (address == kDwtControl) {
    value = 0x40000000 | traceControl_;
    return true;
  }
  if (address == kDwtCycles) {
    value =
        (traceControl_ & 1U) != 0 ? static_cast<std::uint32_t>(cycle - cyclesFrom_) : cyclesHeld_;
    return true;
  }
  const std::uint32_t offset = address - kSpace;
  if (offset >= 0x1000) {
    return false;
  }
  if (Nvic::owns(offset)) {
    value = nvic_.read(offset);
    return true;
  }
  if (offset >= kTickControl && offset <= kTickCalibration) {
    advance(cycle);
    value = readSysTick(offset, cycle);
    return true;
  }
  if (offset >= kShpr1 && offset < kShprEnd) {
    value = 0;
    for (std::uint32_t i = 0; i < 4; ++i) {
      value |= std::uint32_t{nvic_.priorityByte(4 + offset - kShpr1 + i)} << 8 * i;
    }
    return true;
  }
  if (offset >= kFeatures && offset < kFeatures + 4 * std::size(kIdFeatures)) {
    value = kIdFeatures[(offset - kFeatures) / 4];
    return true;
  }
  switch (offset) {
    case kIctr:
      value = (nvic_.lines() + 31) / 32 - 1;
      return true;
    case kActlr:
      value = auxiliary_;
      return true;
    case kCpuid:
      value = 0x410FC241;
      return true;
    case kIcsr:
      value = interruptState(running);
      return true;
    case kVtor:
      value = vectors_;
      return true;
    case kAircr:
      value = 0xFA050000 | nvic_.priorityGroup() << 8;
      return true;
    case kScr:
      value = control_;
      return true;
    case kCcr:
      value = configuration_;
      return true;
    case kShcsr:
      value = handlerState();
      return true;
    case kCfsr:
      value = faultStatus_;
      return true;
    case kHfsr:
      value = hardFaultStatus_;
      return true;
    case kBfar:
    case kMmfar:
      value = busAddress_;
      return true;
    case kDfsr:
    case kAfsr:
    case kMpuType:
    case kDhcsr:
    case kFpcar:
      value = 0;
      return true;
    case kCpacr:
      value = coprocessors_;
      return true;
    case kDemcr:
      value = debug_;
      return true;
    case kFpccr:
      value = fpContext_;
      return true;
    case kFpdscr:
      value = fpDefaults_;
      return true;
    case kMvfr0:
      value = 0x10110021;
      return true;
    case kMvfr1:
      value = 0x11000011;
      return true;
    default:
      return false;
  }
}

void SystemControl::writeSysTick(std::uint32_t offset, std::uint32_t value, std::uint64_t cycle) {
  // ARMv7-M ARM, B3.3
  const auto restart = [this, cycle] { tickZeroAt_ = cycle + tickReload_ + 1; };
  if (offset == kTickControl) {
    const bool was = (tickControl_ & 1U) != 0;
    const bool is = (value & 1U) != 0;
    if (was && !is && tickReload_ != 0) {
      tickValue_ = static_cast<std::uint32_t>(tickZeroAt_ - cycle);
    } else if (!was && is) {
      tickZeroAt_ = cycle + (tickValue_ != 0 ? tickValue_ : tickReload_ + 1);
    }
    tickControl_ = (tickControl_ & kTickCounted) | (value & 7U);
  } else if (offset == kTickReload) {
    const bool stood = tickReload_ == 0;
    tickReload_ = value & 0xFFFFFFU;
    if (stood) {
      restart();
    }
  } else if (offset == kTickValue) {
    tickValue_ = 0;
    tickControl_ &= ~kTickCounted;
    restart();
  }
}

void SystemControl::writeInterruptState(std::uint32_t value) {
  const auto bit = [value](unsigned place) { return (value >> place & 1U) != 0; };
  if (bit(31)) {
    nvic_.pend(2);
  }
  if (bit(28)) {
    nvic_.pend(kPendSv);
  }
  if (bit(27)) {
    nvic_.unpend(kPendSv);
  }
  if (bit(26)) {
    nvic_.pend(kSysTick);
  }
  if (bit(25)) {
    nvic_.unpend(kSysTick);
  }
}

void SystemControl::writeHandlerState(std::uint32_t value) {
  for (unsigned exception = 4; exception <= 6; ++exception) {
    nvic_.enable(exception, (value >> (12 + exception) & 1U) != 0);
  }
}

SystemControl::Written SystemControl::writeBlock(std::uint32_t offset, unsigned size,
                                                 std::uint32_t value) {
  if (offset >= kShpr1 && offset < kShprEnd) {
    for (std::uint32_t i = 0; i < size; ++i) {
      nvic_.setPriority(4 + offset - kShpr1 + i, static_cast<std::uint8_t>(value >> 8 * i));
    }
    return Written::Done;
  }
  if (offset >= kCfsr && offset < kHfsr) {
    faultStatus_ &= ~(value << 8 * (offset - kCfsr));
    return Written::Done;
  }
  if (size != 4) {
    return Written::Misused;
  }
  switch (offset) {
    case kActlr:
      auxiliary_ = value;
      return Written::Done;
    case kIcsr:
      writeInterruptState(value);
      return Written::Done;
    case kVtor:
      vectors_ = value & 0xFFFFFF80U;
      // The size of the vector table is rounded up to a power of two. The address of the table must
      // be a multiple of this size (B3.2.5 and B1.5.3).
      return (vectors_ & 0x1FFU) == 0 || nvic_.lines() <= 16 ? Written::Done : Written::Misused;
    case kAircr:
      if (value >> 16 != 0x05FA) {
        return Written::Misused;
      }
      nvic_.setPriorityGroup(value >> 8 & 7U);
      return (value & 4U) != 0 ? Written::ResetRequested : Written::Done;
    case kScr:
      control_ = value & 0x16U;
      return Written::Done;
    case kCcr:
      configuration_ = value & 0x31BU;
      return Written::Done;
    case kShcsr:
      writeHandlerState(value);
      return Written::Done;
    case kHfsr:
      hardFaultStatus_ &= ~value;
      return Written::Done;
    case kMmfar:
    case kBfar:
      busAddress_ = value;
      return Written::Done;
    case kDfsr:
    case kAfsr:
    case kFpcar:
      return Written::Done;
    case kCpacr:
      coprocessors_ = value & 0x00F00000U;
      return Written::Done;
    case kDemcr:
      debug_ = value;
      return Written::Done;
    case kFpccr:
      fpContext_ = value & 0xC0000000U;
      return Written::Done;
    case kFpdscr:
      fpDefaults_ = value & 0x07C00000U;
      return Written::Done;
    default:
      return Written::Unknown;
  }
}

SystemControl::Written SystemControl::write(std::uint32_t address, unsigned size,
                                            std::uint32_t value, std::uint64_t cycle) {
  if (address == kDwtControl || address == kDwtCycles) {
    if ((debug_ & 1U << 24) == 0 || size != 4) {
      return Written::Misused;
    }
    if (address == kDwtCycles) {
      cyclesFrom_ = cycle - value;
      cyclesHeld_ = value;
    } else if (((traceControl_ ^ value) & 1U) != 0) {
      traceControl_ = value & 1U;
      if (traceControl_ != 0) {
        cyclesFrom_ = cycle - cyclesHeld_;
      } else {
        cyclesHeld_ = static_cast<std::uint32_t>(cycle - cyclesFrom_);
      }
    }
    return Written::Done;
  }
  const std::uint32_t offset = address - kSpace;
  if (offset >= 0x1000) {
    return Written::Unknown;
  }
  if (Nvic::owns(offset)) {
    return nvic_.write(offset, size, value) ? Written::Done : Written::Misused;
  }
  if (offset >= kTickControl && offset < kTickCalibration) {
    if (size != 4) {
      return Written::Misused;
    }
    advance(cycle);
    writeSysTick(offset, value, cycle);
    return Written::Done;
  }
  return writeBlock(offset, size, value);
}

std::uint64_t SystemControl::nextEvent() const {
  return (tickControl_ & 1U) != 0 && tickReload_ != 0 ? tickZeroAt_ : kNever;
}

void SystemControl::advance(std::uint64_t cycle) {
  while (nextEvent() <= cycle) {
    tickZeroAt_ += std::uint64_t{tickReload_} + 1;
    tickControl_ |= kTickCounted;
    if ((tickControl_ & 2U) != 0) {
      nvic_.pend(kSysTick);
    }
  }
}

}  // namespace wr::emulator
