#include "sim/emulator/processor/Core.hpp"
#include "sim/emulator/processor/Encoding.hpp"

// System instructions (ARMv7-M ARM, A5.2.5, A5.3.4, B5.2).

namespace wr::emulator {

namespace {

// Numbers of the special registers, B5.1.1.
constexpr std::uint32_t kMsp = 8;
constexpr std::uint32_t kPsp = 9;
constexpr std::uint32_t kPrimask = 16;
constexpr std::uint32_t kBasepri = 17;
constexpr std::uint32_t kBasepriMax = 18;
constexpr std::uint32_t kFaultmask = 19;
constexpr std::uint32_t kControl = 20;

void nothing(Core& /*core*/, const Instruction& /*in*/) {}

void isb(Core& core, const Instruction& /*in*/) {
  core.spend(kBarrierCycles);
}

void clrex(Core& core, const Instruction& /*in*/) {
  core.exclusive = false;
}

void wfi(Core& core, const Instruction& /*in*/) {
  core.trap(Trap::Sleep);
}

void svc(Core& core, const Instruction& /*in*/) {
  core.trap(Trap::SupervisorCall);
}

void bkpt(Core& core, const Instruction& /*in*/) {
  core.trap(Trap::Breakpoint);
}

void it(Core& core, const Instruction& in) {
  core.registers.it = static_cast<std::uint8_t>(in.value);
}

// The handlers of NMI and HardFault cannot set FAULTMASK (B5.2.1 and B5.2.3).
void setFaultmask(Core& core, std::uint32_t value) {
  Registers& x = core.registers;
  if (value == 0 || (x.exception != 2 && x.exception != 3)) {
    x.faultmask = value;
  }
}

// Bit 4 of `value` disables interrupts. Bit 1 selects PRIMASK, and bit 0 selects FAULTMASK.
void cps(Core& core, const Instruction& in) {
  core.spend(kSpecialCycles);
  if (!core.registers.privileged()) {
    return;
  }
  const std::uint32_t mask = in.value >> 4 & 1U;
  if ((in.value & 2U) != 0) {
    core.registers.primask = mask;
  }
  if ((in.value & 1U) != 0) {
    setFaultmask(core, mask);
  }
  core.masksChanged();
}

std::uint32_t special(const Core& core, std::uint32_t number) {
  const Registers& x = core.registers;
  if (number < 8) {
    return ((number & 4U) == 0 ? x.flags() & 0xF80F0000U : 0) |
           ((number & 1U) != 0 ? x.exception : 0);  // EPSR reads as zero
  }
  if (!x.privileged() && number != kControl) {
    return 0;
  }
  switch (number) {
    case kMsp:
      return x.onProcessStack ? x.otherStack : x.r[Registers::kStack];
    case kPsp:
      return x.onProcessStack ? x.r[Registers::kStack] : x.otherStack;
    case kPrimask:
      return x.primask;
    case kBasepri:
    case kBasepriMax:
      return x.basepri;
    case kFaultmask:
      return x.faultmask;
    case kControl:
      return x.control;
    default:
      return 0;
  }
}

void mrs(Core& core, const Instruction& in) {
  core.spend(kSpecialCycles);
  core.registers.r[in.d] = special(core, in.value);
}

void setControl(Registers& x, std::uint32_t value) {
  std::uint32_t control = (value & (Registers::kUnprivileged | Registers::kFpActive)) |
                          (x.control & Registers::kProcessStack);
  if (x.exception == 0) {
    control = (control & ~Registers::kProcessStack) | (value & Registers::kProcessStack);
    x.useStack((control & Registers::kProcessStack) != 0);
  }
  x.control = control;
}

void setPrivileged(Core& core, std::uint32_t number, std::uint32_t value) {
  Registers& x = core.registers;
  switch (number) {
    case kMsp:
      x.mainStack() = value & ~3U;
      return;
    case kPsp:
      x.processStack() = value & ~3U;
      return;
    case kPrimask:
      x.primask = value & 1U;
      break;
    case kBasepri:
      x.basepri = value & core.priorityMask;
      break;
    case kBasepriMax:
      if (const std::uint32_t base = value & core.priorityMask;
          base != 0 && (x.basepri == 0 || base < x.basepri)) {
        x.basepri = base;
      }
      break;
    case kFaultmask:
      setFaultmask(core, value & 1U);
      break;
    case kControl:
      setControl(x, value);
      return;
    default:
      return;
  }
  core.masksChanged();
}

// The field `value` is the number of the register. The field `m` is the mask of the flags: 2 for N
// to Q, 1 for GE.
void msr(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  core.spend(kSpecialCycles);
  const std::uint32_t value = x.r[in.n];
  if (in.value < 8) {
    if ((in.value & 4U) == 0 && (in.m & 2U) != 0) {
      x.setFlags(value);
    }
    if ((in.value & 4U) == 0 && (in.m & 1U) != 0) {
      x.setGe(value);
    }
  } else if (x.privileged()) {
    setPrivileged(core, in.value, value);
  }
}

Instruction hint(unsigned number) {
  constexpr unsigned kWfi = 3;
  // WFE may end at any time (ARMv7-M ARM, B1.5.17). In this model it ends immediately.
  return {.run = number == kWfi ? wfi : nothing};
}

Instruction barrier(Encoding code) {
  switch (code.field(7, 4)) {
    case 2:
      return {.run = clrex};
    case 4:
    case 5:
      return {.run = nothing};
    case 6:
      return {.run = isb};
    default:
      return undefined();
  }
}

}  // namespace

Instruction shortSystem(Encoding code) {
  switch (code.field(15, 8)) {
    case 0xB6:
      return code.field(7, 5) == 0b011 ? Instruction{.run = cps, .value = code.field(4, 0)}
                                       : undefined();
    case 0xBE:
      return {.run = bkpt, .form = Instruction::kUnconditional};  // A7.7.17
    case 0xBF:
      return code.field(3, 0) == 0 ? hint(code.field(7, 4))
                                   : Instruction{.run = it, .value = code.field(7, 0)};
    case 0xDF:
      return {.run = svc};
    default:
      return undefined();
  }
}

Instruction system(Encoding code) {
  switch (code.field(26, 20)) {
    case 0b0111000:
    case 0b0111001:
      return {.run = msr,
              .value = code.field(7, 0),
              .n = code.reg(16),
              .m = static_cast<std::uint8_t>(code.field(11, 10))};
    case 0b0111010:
      return code.field(10, 8) == 0 ? hint(code.field(7, 0)) : undefined();
    case 0b0111011:
      return barrier(code);
    case 0b0111110:
    case 0b0111111:
      return {.run = mrs, .value = code.field(7, 0), .d = code.reg(8)};
    default:
      return undefined();
  }
}

}  // namespace wr::emulator
