#include "sim/emulator/CortexM4.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <utility>

namespace wr::emulator {

namespace {

constexpr unsigned kNmi = 2;
constexpr unsigned kHardFault = 3;
constexpr unsigned kMemoryFault = 4;
constexpr unsigned kBusFault = 5;
constexpr unsigned kUsageFault = 6;
constexpr unsigned kSupervisorCall = 11;
constexpr unsigned kFirstLine = 16;

// An interrupt counts as endless when it is entered this number of times after one rise of its
// interrupt line.
constexpr unsigned kStorm = 1000;

constexpr std::uint32_t kAlignedBit = 1U << 9;
constexpr std::uint32_t kThumbBit = 1U << 24;

std::string hex(std::uint32_t value) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "0x%08X", static_cast<unsigned>(value));
  return text.data();
}

}  // namespace

CortexM4::CortexM4(unsigned lines, unsigned priorityBits, Timing timing)
    : core_(timing), nvic_(lines, priorityBits), system_(nvic_) {
  core_.priorityMask = 0xFF00U >> priorityBits & 0xFFU;
  const auto read = [this](std::uint32_t address, unsigned size) {
    return readSystem(address, size);
  };
  const auto write = [this](std::uint32_t address, unsigned size, std::uint32_t value) {
    writeSystem(address, size, value);
  };
  mapWindow(0xE000E000, 0x1000, read, write);
  mapWindow(0xE0000000, 0x3000, read, write);
}

std::uint32_t CortexM4::readSystem(std::uint32_t address, unsigned size) {
  std::uint32_t word = 0;
  if (!system_.read(address & ~3U, cycles(), exception(), word)) {
    unmodelled(address, "load from " + hex(address));
  }
  const std::uint32_t part = word >> 8 * (address & 3U);
  return size == 4 ? part : part & ((1U << 8 * size) - 1);
}

bool CortexM4::inspectSystem(std::uint32_t address, std::uint32_t& value) {
  constexpr std::uint32_t kTickControl = 0xE000E010;  // reading clears COUNTFLAG
  return address != kTickControl && system_.read(address, cycles(), exception(), value);
}

void CortexM4::writeSystem(std::uint32_t address, unsigned size, std::uint32_t value) {
  switch (system_.write(address, size, value, cycles())) {
    case SystemControl::Written::Done:
      break;
    case SystemControl::Written::ResetRequested:
      if (resetCall_) {
        resetCall_();
      } else {
        report("reset-request", "the program asks for a reset");
      }
      break;
    case SystemControl::Written::Unknown:
      unmodelled(address, "store of " + hex(value) + " to " + hex(address));
      break;
    case SystemControl::Written::Misused:
      report("register-misuse", "store of " + hex(value) + " to " + hex(address));
      break;
  }
  systemChanged();
  reevaluate();
}

// Copies values of system control to the core: only the values that the core needs.
void CortexM4::systemChanged() {
  core_.fpu = {
      .on = system_.fpuOn(), .activates = system_.fpuStacks(), .defaults = system_.fpDefaults()};
  core_.trapsUnaligned = system_.trapsUnaligned();
  core_.trapsDivideByZero = system_.trapsDivideByZero();
}

void CortexM4::mapMemory(std::uint32_t address, std::uint32_t size, Access access) {
  core_.memory.map(address, size, access);
}

void CortexM4::mapWindow(std::uint32_t address, std::uint32_t size, Read read, Write write) {
  core_.memory.map(address, size, std::move(read), std::move(write));
}

void CortexM4::load(std::uint32_t address, std::span<const std::uint8_t> bytes) {
  core_.memory.load(address, bytes);
}

std::uint32_t CortexM4::core(unsigned number) const {
  return number == Registers::kPc ? pc() : core_.registers.r.at(number);
}

void CortexM4::setCore(unsigned number, std::uint32_t value) {
  if (number == Registers::kPc) {
    core_.next = value & ~1U;
    core_.registers.r[Registers::kPc] = core_.next + 4;
  } else {
    core_.registers.r.at(number) = value;
  }
}

std::uint32_t CortexM4::pc() const {
  return running_ ? core_.at() : core_.next;
}

const std::optional<CortexM4::Problem>& CortexM4::problem() const {
  return problem_;
}

void CortexM4::setFaultsAreProblems(bool problems) {
  faultsAreProblems_ = problems;
}

void CortexM4::onSemihosting(std::function<void(CortexM4&)> call) {
  semihosting_ = std::move(call);
}

void CortexM4::onException(std::function<void(Step, unsigned)> call) {
  exceptionCall_ = std::move(call);
}

void CortexM4::onResetRequest(std::function<void()> call) {
  resetCall_ = std::move(call);
}

void CortexM4::onLockup(std::function<void()> call) {
  lockupCall_ = std::move(call);
}

void CortexM4::onUnmodelled(std::function<bool(const std::string&)> call) {
  unmodelledCall_ = std::move(call);
}

void CortexM4::onBlock(std::function<void(std::uint32_t)> call) {
  core_.onBlock(std::move(call));
}

void CortexM4::reset() {
  nvic_.reset();
  system_.reset(cycles());
  systemChanged();
  core_.registers = Registers{};
  core_.registers.r[Registers::kStack] = word(0) & ~3U;
  core_.registers.r[Registers::kLink] = 0xFFFFFFFF;
  core_.exclusive = false;
  core_.next = word(4) & ~1U;
  core_.beginBlock();
  blockWaits_.clear();
  sleeping_ = false;
  raised_ = 0;
  refused_.reset();
  if ((word(4) & 1U) == 0) {
    report("vector-missing", "the vector of reset is " + hex(word(4)));
  }
}

void CortexM4::limitTo(std::uint64_t cycle) {
  limit_ = std::min(limit_, cycle);
  core_.setStop(std::min(core_.stop(), limit_));
}

void CortexM4::exit() {
  exit_ = true;
  stop();
}

void CortexM4::skipTo(std::uint64_t cycle) {
  if (cycle > cycles()) {
    core_.spend(cycle - cycles());
  }
}

void CortexM4::setLine(unsigned line, bool high) {
  if (nvic_.setLine(line, high)) {
    reevaluate();
  }
}

void CortexM4::raise(unsigned exception) {
  if (exception == kNmi || exception >= kSupervisorCall) {
    nvic_.pend(exception);
  } else {
    raised_ = exception;
  }
  reevaluate();
}

void CortexM4::report(std::string id, std::string what) {
  if (!problem_) {
    problem_ = Problem{std::move(id), std::move(what), pc()};
  }
  reevaluate();
}

void CortexM4::unmodelled(std::uint32_t address, const std::string& what) {
  if (!isTolerated(what)) {
    refuse(address, "unmodelled-register", what);
  }
}

bool CortexM4::isTolerated(const std::string& what) const {
  return unmodelledCall_ && unmodelledCall_(what);
}

void CortexM4::refuse(std::uint32_t address, std::string id, std::string event) {
  if (faultsAreProblems_) {
    report(std::move(id), std::move(event));
  } else if (!refused_) {
    refused_ = Refused{address, std::move(id), std::move(event)};
    core_.trap(Trap::Refused);
  }
}

int CortexM4::executionPriority(bool withPrimask) const {
  // ARMv7-M ARM, B1.5.4
  const Registers& x = core_.registers;
  int priority = nvic_.activePriority();
  if (x.basepri != 0) {
    priority = std::min(priority, nvic_.group(static_cast<int>(x.basepri)));
  }
  if (withPrimask && x.primask != 0) {
    priority = std::min(priority, 0);
  }
  if (x.faultmask != 0) {
    priority = std::min(priority, -1);
  }
  return priority;
}

CortexM4::Stop CortexM4::run(std::uint64_t limit) {
  limit_ = limit;
  while (true) {
    if (problem_) {
      return Stop::Problem;
    }
    if (std::exchange(exit_, false)) {
      return Stop::Exit;
    }
    system_.advance(cycles());
    takePending();
    if (problem_) {
      return Stop::Problem;
    }
    if (cycles() >= limit_) {
      return Stop::Limit;
    }
    if (sleeping_) {
      if (system_.nextEvent() >= limit_) {
        return Stop::Sleep;
      }
      skipTo(system_.nextEvent());
      continue;
    }
    execute();
  }
}

void CortexM4::takePending() {
  core_.maskedPending = false;
  if (raised_ != 0) {
    const unsigned exception = std::exchange(raised_, 0);
    sleeping_ = false;
    system_.noteFault(exception == kBusFault      ? SystemControl::kImpreciseBus
                      : exception == kUsageFault  ? SystemControl::kUndefined
                      : exception == kMemoryFault ? SystemControl::kInstructionViolation
                                                  : 0);
    deliver(exception, pc());
    return;
  }
  // After an entry, another exception may preempt the handler before its first instruction. The
  // manual calls this case late arrival.
  while (enterNext()) {
  }
}

// Enters the pending exception with the highest priority, if this priority permits the entry.
bool CortexM4::enterNext() {
  const unsigned next = nvic_.first();
  if (next == 0) {
    return false;
  }
  const int wanted = nvic_.group(nvic_.priority(next));
  if (wanted >= nvic_.activePriority()) {
    return false;  // the exception waits until another exception returns, or until the program
                   // writes a register of the NVIC
  }
  // WFI also ends when only PRIMASK blocks the interrupt (ARMv7-M ARM, B1.5.18).
  if (sleeping_) {
    sleeping_ = wanted >= executionPriority(false);
  }
  if (wanted >= executionPriority()) {
    core_.maskedPending = true;  // the exception waits until the program changes a mask
    return false;
  }
  enter(next, pc());
  return true;
}

void CortexM4::execute() {
  core_.setStop(std::min(limit_, system_.nextEvent()));
  running_ = true;
  const Trap trap = core_.run();
  running_ = false;
  if (trap != Trap::None && !problem_) {
    serve(trap);
  }
}

void CortexM4::serve(Trap trap) {
  switch (trap) {
    case Trap::None:
      return;
    case Trap::Sleep:
      sleep();
      return;
    case Trap::SupervisorCall:
      supervisorCall();
      return;
    case Trap::ExceptionReturn:
      exceptionReturn(core_.trapAddress());
      return;
    case Trap::Breakpoint:
      breakpoint();
      return;
    case Trap::Undefined:
    case Trap::NoCoprocessor:
    case Trap::FpuOff:
    case Trap::InvalidState:
    case Trap::Unaligned:
    case Trap::DivideByZero:
    case Trap::InstructionBus:
    case Trap::InstructionViolation:
      instructionFault(trap);
      return;
    default:
      accessFault(trap);
      return;
  }
}

void CortexM4::sleep() {
  const std::string what = "WFI with SCR.SLEEPDEEP: stop modes are not modelled";
  if (system_.sleepsDeep() && !isTolerated(what)) {
    report("unmodelled-register", what);
  }
  sleeping_ = true;
}

void CortexM4::supervisorCall() {
  deliver(kSupervisorCall, core_.next);
}

void CortexM4::breakpoint() {
  constexpr std::uint16_t kSemihosting = 0xBEAB;
  const std::uint32_t at = core_.at();
  if (core_.memory.read<std::uint16_t>(at) == kSemihosting && semihosting_) {
    semihosting_(*this);
    return;
  }
  system_.noteHardFault(SystemControl::kDebugEvent);
  fault(kHardFault, 0, at, "unhandled-fault", "breakpoint");
}

// Raises a fault because of the kind or the address of an instruction (ARMv7-M ARM, B1.5.14).
void CortexM4::instructionFault(Trap trap) {
  const std::uint32_t at = core_.at();
  const auto usage = [this](std::uint32_t status, std::uint32_t pc, const char* id,
                            const std::string& what) { fault(kUsageFault, status, pc, id, what); };
  switch (trap) {
    case Trap::NoCoprocessor:
      usage(SystemControl::kNoCoprocessor, at, "unhandled-fault",
            "instruction of a coprocessor that does not exist");
      return;
    case Trap::FpuOff:
      usage(SystemControl::kNoCoprocessor, at, "fpu-off",
            "floating-point instruction while the FPU is off");
      return;
    case Trap::InvalidState:
      usage(SystemControl::kInvalidState, core_.next, "unhandled-fault",
            "branch to " + hex(core_.next) + " without the bit that marks Thumb code");
      return;
    case Trap::Unaligned:
      usage(SystemControl::kUnaligned, at, "unhandled-fault",
            "unaligned access that is not permitted");
      return;
    case Trap::DivideByZero:
      usage(SystemControl::kDivideByZero, at, "unhandled-fault", "division by zero");
      return;
    case Trap::InstructionBus:
      fault(kBusFault, SystemControl::kInstructionBus, at, "unmapped-memory",
            "execution at " + hex(core_.trapAddress()));
      return;
    case Trap::InstructionViolation:
      fault(kMemoryFault, SystemControl::kInstructionViolation, at, "unhandled-fault",
            "execution at " + hex(core_.trapAddress()) + ", where no code is allowed");
      return;
    default:
      usage(SystemControl::kUndefined, at, "unhandled-fault",
            "undefined instruction " + hex(core_.memory.read<std::uint16_t>(at)));
      return;
  }
}

// Raises the precise bus faults of loads and stores.
void CortexM4::accessFault(Trap trap) {
  const std::string address = hex(core_.trapAddress());
  const auto refused = std::exchange(refused_, std::nullopt);
  const bool store = trap == Trap::StoreBus || trap == Trap::StoreAcross;
  const bool across = trap == Trap::LoadAcross || trap == Trap::StoreAcross;
  system_.noteBusAddress(refused ? refused->address : core_.trapAddress());
  const auto bus = [this](const std::string& id, const std::string& what) {
    fault(kBusFault, SystemControl::kPreciseBus, core_.at(), id, what);
  };
  if (refused) {
    bus(refused->id, refused->what);
  } else if (trap == Trap::FlashStore) {
    bus("flash-store", "store to " + address);
  } else if (across) {
    bus("unmapped-memory",
        (store ? "store at " : "load at ") + address + " across the border of two memories");
  } else {
    bus("unmapped-memory", (store ? "store to " : "load from ") + address);
  }
}

void CortexM4::fault(unsigned exception, std::uint32_t status, std::uint32_t pc,
                     const std::string& id, const std::string& what) {
  system_.noteFault(status);
  if (faultsAreProblems_) {
    core_.next = pc & ~1U;
    report(id, what);
    return;
  }
  deliver(exception, pc);
}

// If a fault cannot be entered, it becomes a HardFault. If a HardFault cannot be entered, the
// processor locks up (ARMv7-M ARM, B1.5.14).
void CortexM4::deliver(unsigned exception, std::uint32_t pc) {
  const int running = executionPriority();
  unsigned taken = exception;
  if (taken != kHardFault &&
      (!nvic_.isEnabled(taken) || nvic_.group(nvic_.priority(taken)) >= running)) {
    taken = kHardFault;
    system_.noteHardFault(SystemControl::kForced);
  }
  if (taken == kHardFault && running <= -1) {
    lockUp(pc);
    return;
  }
  enter(taken, pc);
}

void CortexM4::lockUp(std::uint32_t pc) {
  core_.next = pc & ~1U;
  if (lockupCall_) {
    lockupCall_();
    stop();
  } else {
    report("lockup", "a fault in the handler of a fault");
  }
}

// PushStack of ARMv7-M ARM, B1.5.6. The floating-point registers are stacked immediately.
bool CortexM4::stack(std::uint32_t returnsTo, std::uint32_t& link) {
  Registers& x = core_.registers;
  const std::uint32_t before = x.r[Registers::kStack];
  const bool thread = x.exception == 0;
  const bool withFp = (x.control & Registers::kFpActive) != 0;
  const bool align = system_.alignsStack() || withFp;
  const std::uint32_t size = withFp ? 0x68 : 0x20;
  const std::uint32_t frame = (before - size) & (align ? ~7U : ~3U);
  std::array<std::uint32_t, 26> words{
      x.r[0],          x.r[1],
      x.r[2],          x.r[3],
      x.r[12],         x.r[Registers::kLink],
      returnsTo & ~1U, x.state() | (align && (before & 4U) != 0 ? kAlignedBit : 0)};
  if (withFp) {
    std::copy_n(x.s.begin(), 16, words.begin() + 8);
    words[24] = x.fpscr;
  }
  link = 0xFFFFFFE1U | (withFp ? 0 : 0x10U) | (thread ? 8U : 0) |
         (thread && x.onProcessStack ? 4U : 0);
  x.r[Registers::kStack] = frame;
  std::uint8_t* place = core_.memory.stack(frame, size);
  if (place == nullptr) {
    return false;
  }
  std::memcpy(place, words.data(), size);
  return true;
}

void CortexM4::enter(unsigned exception, std::uint32_t returnsTo) {
  core_.spend(kEntryCycles);
  sleeping_ = false;
  std::uint32_t link = 0;
  const bool beginsBlock = core_.beginsBlock();
  if (!stack(returnsTo, link)) {
    const std::string what = "no memory for the stack frame of exception " +
                             std::to_string(exception) + " at " +
                             hex(core_.registers.r[Registers::kStack]);
    system_.noteFault(SystemControl::kStackingBus);
    if (faultsAreProblems_) {
      report("unmapped-memory", what);
      return;
    }
    // A fault during stacking is entered instead of the exception. The exception stays pending. The
    // handler of the fault runs although its stack frame is lost (ARM DDI 0337E, 5.12.1).
    const int running = executionPriority();
    const bool bus = nvic_.isEnabled(kBusFault) &&
                     nvic_.group(nvic_.priority(kBusFault)) < running &&
                     nvic_.priority(kBusFault) <= nvic_.priority(exception);
    if (!bus && running <= -1) {
      lockUp(returnsTo);
      return;
    }
    if (!bus) {
      system_.noteHardFault(SystemControl::kForced);
    }
    vector(bus ? kBusFault : kHardFault, link);
    return;
  }
  blockWaits_.push_back(beginsBlock);
  vector(exception, link);
}

// ExceptionTaken of ARMv7-M ARM, B1.5.6.
void CortexM4::vector(unsigned exception, std::uint32_t link) {
  Registers& x = core_.registers;
  const std::uint32_t place = system_.vectors() + 4 * exception;
  const std::uint32_t handler = word(place);
  const bool storm = nvic_.entriesOfHighLine(exception) >= kStorm;
  core_.spendForRead(place);
  nvic_.activate(exception);
  x.useStack(false);
  x.control &= Registers::kUnprivileged;
  x.r[Registers::kLink] = link;
  x.exception = exception;
  x.it = 0;
  x.thumb = true;
  core_.exclusive = false;
  core_.continueBlock();
  if ((handler & 1U) == 0) {
    report("vector-missing",
           "the vector of exception " + std::to_string(exception) + " is " + hex(handler));
    return;
  }
  core_.next = handler & ~1U;
  if (exceptionCall_) {
    exceptionCall_(Step::Entered, exception);
  }
  if (storm) {
    report("interrupt-storm", "interrupt " + std::to_string(exception - kFirstLine) +
                                  " was entered " + std::to_string(kStorm) +
                                  " times and its line is still high");
  }
}

bool CortexM4::linkIsValid(std::uint32_t link, unsigned number) const {
  // ARMv7-M ARM, B1.5.8: ExceptionReturn
  const std::uint32_t kind = link & 0xFU;
  const bool known = (link | 0x1FU) == 0xFFFFFFFFU && (kind == 1 || kind == 9 || kind == 13);
  if (!known || !nvic_.isActive(number)) {
    return false;
  }
  const bool nested = nvic_.activeCount() > 1;
  return kind == 1 ? nested : !nested || system_.threadFromAnyLevel();
}

void CortexM4::exceptionReturn(std::uint32_t link) {
  const unsigned number = exception();
  if (!linkIsValid(link, number)) {
    fault(kUsageFault, SystemControl::kInvalidPc, link, "unhandled-fault",
          "return from exception " + std::to_string(number) + " with " + hex(link));
    return;
  }
  nvic_.deactivate(number);
  if (number != kNmi) {
    core_.registers.faultmask = 0;
  }
  if (exceptionCall_) {
    exceptionCall_(Step::Left, number);
  }
  const unsigned next = nvic_.first();
  if (next != 0 && nvic_.group(nvic_.priority(next)) < executionPriority()) {
    core_.spend(kTailCycles);
    vector(next, link);
    return;
  }
  core_.spend(kExitCycles);
  unstack(link);
}

// PopStack of ARMv7-M ARM, B1.5.8.
void CortexM4::unstack(std::uint32_t link) {
  Registers& x = core_.registers;
  const bool toThread = (link & 8U) != 0;
  const bool process = (link & 4U) != 0;
  const bool withFp = (link & 0x10U) == 0;
  const std::uint32_t frame = process ? x.processStack() : x.mainStack();
  const std::uint32_t size = withFp ? 0x68 : 0x20;
  const std::uint8_t* place = core_.memory.stack(frame, size);
  if (place == nullptr) {
    fault(kBusFault, SystemControl::kUnstackingBus, link, "unmapped-memory",
          "no stack frame of exception " + std::to_string(x.exception) + " at " + hex(frame));
    return;
  }
  std::array<std::uint32_t, 26> words{};
  std::memcpy(words.data(), place, size);
  const std::uint32_t state = words[7];
  if (toThread != ((state & 0x1FFU) == 0) || (state & kThumbBit) == 0) {
    fault(kUsageFault,
          (state & kThumbBit) == 0 ? SystemControl::kInvalidState : SystemControl::kInvalidPc,
          words[6], "unhandled-fault",
          "return from exception " + std::to_string(x.exception) + " to the state " + hex(state));
    return;
  }
  if (withFp) {
    std::copy_n(words.begin() + 8, 16, x.s.begin());
    x.fpscr = words[24];
  }
  std::copy_n(words.begin(), 4, x.r.begin());
  x.r[12] = words[4];
  x.r[Registers::kLink] = words[5];
  x.setState(state);
  x.useStack(process);
  x.control = (x.control & Registers::kUnprivileged) | (process ? Registers::kProcessStack : 0) |
              (withFp ? Registers::kFpActive : 0);
  const bool aligned = (state & kAlignedBit) != 0 && (system_.alignsStack() || withFp);
  x.r[Registers::kStack] = (frame + size) | (aligned ? 4U : 0);
  core_.next = words[6] & ~1U;
  core_.exclusive = false;
  core_.continueBlock();
  if (!blockWaits_.empty()) {
    if (blockWaits_.back()) {
      core_.beginBlock();
    }
    blockWaits_.pop_back();
  }
  sleeping_ = toThread && system_.sleepsOnExit();
}

}  // namespace wr::emulator
