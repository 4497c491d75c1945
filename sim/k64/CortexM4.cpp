#include "sim/k64/CortexM4.hpp"

#include <unicorn/unicorn.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <cstring>
#include <new>
#include <stdexcept>
#include <utility>

#include "sim/k64/ExecutedCode.hpp"

// What is said of Unicorn below holds for version 2.0.1.

// Two functions of the engine, in place of its own: they make the list of the pages that a store to
// memory locks against other threads, which a run of the engine does not have. That list took most
// of the time of a store. Where they are not put in place of the engine's, all is only slower.
// NOLINTBEGIN(readability-identifier-naming): named by the engine
extern "C" {
void* page_collection_lock_arm(void* engine, std::uint64_t first, std::uint64_t last);
void page_collection_unlock_arm(void* pages);

void* page_collection_lock_arm(void* engine, std::uint64_t /*first*/, std::uint64_t /*last*/) {
  return engine;
}

void page_collection_unlock_arm(void* /*pages*/) {}
}
// NOLINTEND(readability-identifier-naming)

namespace wr::k64 {

namespace {

constexpr unsigned kNmi = 2;
constexpr unsigned kHardFault = 3;
constexpr unsigned kMemoryFault = 4;
constexpr unsigned kBusFault = 5;
constexpr unsigned kUsageFault = 6;
constexpr unsigned kSupervisorCall = 11;
constexpr unsigned kFirstLine = 16;

constexpr std::uint32_t kPage = 4096;

constexpr std::uint64_t kEntryCycles = 12;
constexpr std::uint64_t kExitCycles = 10;
constexpr std::uint64_t kTailCycles = 6;

// Entries for one rise of a line from which an interrupt cannot recover.
constexpr unsigned kStorm = 1000;

// Exceptions of the engine, as the hook for interrupts gets them.
constexpr int kEngineUndefined = 1;
constexpr int kEngineCall = 2;
constexpr int kEngineNoExecution = 3;
constexpr int kEngineBreakpoint = 7;
constexpr int kEngineReturn = 8;

constexpr std::uint32_t kAlignedBit = 1U << 9;
constexpr std::uint32_t kThumbBit = 1U << 24;
constexpr std::uint32_t kItBits = 0x0600FC00;  // what an IT block still demands
constexpr std::uint32_t kFpActive = 4;         // CONTROL.FPCA
constexpr std::uint32_t kProcessStack = 2;     // CONTROL.SPSEL

constexpr std::uint16_t kWfi = 0xBF30;
constexpr std::uint16_t kWfe = 0xBF20;
constexpr std::uint16_t kYield = 0xBF10;

void check(uc_err error, const char* what) {
  if (error != UC_ERR_OK) {
    throw std::runtime_error(std::string(what) + ": " + uc_strerror(error));
  }
}

std::string hex(std::uint32_t value) {
  std::array<char, 16> text{};
  std::snprintf(text.data(), text.size(), "0x%08X", static_cast<unsigned>(value));
  return text.data();
}

void* pointer(void (*function)()) {
  return reinterpret_cast<void*>(function);
}

}  // namespace

struct CortexM4::Hooks {
  static void code(uc_engine* engine, std::uint64_t address, std::uint32_t /*size*/, void* user) {
    CortexM4& cpu = *static_cast<CortexM4*>(user);
    cpu.pc_ = static_cast<std::uint32_t>(address);
    if (cpu.cycles_ < cpu.stopAt_ && !cpu.looks_) [[likely]] {
      ++cpu.cycles_;
    } else {
      cpu.lookAt(engine);
    }
  }

  static void block(uc_engine* /*engine*/, std::uint64_t address, std::uint32_t /*size*/,
                    void* user) {
    CortexM4& cpu = *static_cast<CortexM4*>(user);
    if (!std::exchange(cpu.resumed_, false)) {
      cpu.blockCall_(static_cast<std::uint32_t>(address));
    }
  }

  static void interrupt(uc_engine* engine, std::uint32_t number, void* user) {
    static_cast<CortexM4*>(user)->interrupt_ = static_cast<int>(number);
    uc_emu_stop(engine);
  }

  static bool invalid(uc_engine* /*engine*/, uc_mem_type type, std::uint64_t address, int size,
                      std::int64_t value, void* user) {
    CortexM4& cpu = *static_cast<CortexM4*>(user);
    const auto first = static_cast<std::uint32_t>(address);
    if ((type == UC_MEM_READ_PROT || type == UC_MEM_WRITE_PROT) && first < cpu.borderAt_ &&
        cpu.borderAt_ - first <= kPage) {
      const auto bytes = static_cast<unsigned>(size);
      if (first + bytes > cpu.borderAt_) {
        cpu.refuse(first, "unmapped-memory",
                   (type == UC_MEM_WRITE_PROT ? "store at " : "load at ") + hex(first) +
                       " across the border of two memories");
      } else if (type == UC_MEM_WRITE_PROT) {
        std::memcpy(cpu.at(first, bytes), &value, bytes);  // the engine does not
      }
      return true;
    }
    cpu.badAccess_ = type;
    cpu.badAddress_ = first;
    return false;
  }

  static std::uint64_t read(uc_engine* /*engine*/, std::uint64_t offset, unsigned size,
                            void* user) {
    const Window& window = *static_cast<Window*>(user);
    return window.read(window.address + static_cast<std::uint32_t>(offset), size);
  }

  static void write(uc_engine* /*engine*/, std::uint64_t offset, unsigned size, std::uint64_t value,
                    void* user) {
    const Window& window = *static_cast<Window*>(user);
    window.write(window.address + static_cast<std::uint32_t>(offset), size,
                 static_cast<std::uint32_t>(value));
  }

  template <typename Function>
  static void add(CortexM4& cpu, int type, Function function, std::uint64_t begin = 1,
                  std::uint64_t end = 0) {
    uc_hook hook{};
    check(uc_hook_add(cpu.engine_, &hook, type, pointer(reinterpret_cast<void (*)()>(function)),
                      &cpu, begin, end),
          "uc_hook_add");
  }
};

CortexM4::CortexM4(unsigned lines, unsigned priorityBits)
    : nvic_(lines, priorityBits), system_(nvic_) {
  // UC_MODE_MCLASS would make a Cortex-M33; the model is set before any other call.
  check(uc_open(UC_ARCH_ARM, UC_MODE_THUMB, &engine_), "uc_open");
  check(uc_ctl_set_cpu_model(engine_, UC_CPU_ARM_CORTEX_M4), "uc_ctl_set_cpu_model");
  // No address ends a run. With one, the engine would throw its translation away after each run.
  check(uc_ctl_exits_enable(engine_), "uc_ctl_exits_enable");
  Hooks::add(*this, UC_HOOK_CODE, Hooks::code);
  Hooks::add(*this, UC_HOOK_INTR, Hooks::interrupt);
  Hooks::add(*this, UC_HOOK_MEM_INVALID, Hooks::invalid);
  const auto readSystem = [this](std::uint32_t address, unsigned size) {
    std::uint32_t word = 0;
    if (!system_.read(address & ~3U, cycles_, exception(), word)) {
      refuse(address, "unmodelled-register", "load from " + hex(address));
    }
    const std::uint32_t part = word >> 8 * (address & 3U);
    return size == 4 ? part : part & ((1U << 8 * size) - 1);
  };
  const auto writeSystem = [this](std::uint32_t address, unsigned size, std::uint32_t value) {
    switch (system_.write(address, size, value, cycles_)) {
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
        refuse(address, "unmodelled-register", "store of " + hex(value) + " to " + hex(address));
        break;
      case SystemControl::Written::Misused:
        report("register-misuse", "store of " + hex(value) + " to " + hex(address));
        break;
    }
    reevaluate();
  };
  mapWindow(0xE000E000, 0x1000, readSystem, writeSystem);
  mapWindow(0xE0000000, 0x3000, readSystem, writeSystem);
}

CortexM4::~CortexM4() {
  uc_close(engine_);
}

void CortexM4::mapMemory(std::uint32_t address, std::uint32_t size, Access access) {
  mapMemory(address, size,
            access == Access::ReadWrite     ? UC_PROT_READ | UC_PROT_WRITE
            : access == Access::ReadExecute ? UC_PROT_READ | UC_PROT_EXEC
                                            : UC_PROT_ALL,
            access);
}

void CortexM4::mapMemory(std::uint32_t address, std::uint32_t size, std::uint32_t rights,
                         Access access) {
  std::unique_ptr<std::uint8_t, Release> bytes(
      static_cast<std::uint8_t*>(std::aligned_alloc(kPage, size)));
  if (bytes == nullptr) {
    throw std::bad_alloc();
  }
  std::fill_n(bytes.get(), size, std::uint8_t{0});
  check(uc_mem_map_ptr(engine_, address, size, rights, bytes.get()), "uc_mem_map_ptr");
  memories_.push_back({address, size, access, std::move(bytes)});
}

void CortexM4::mapWindow(std::uint32_t address, std::uint32_t size, Read read, Write write) {
  windows_.push_back(
      std::make_unique<Window>(Window{this, address, std::move(read), std::move(write)}));
  void* user = windows_.back().get();
  check(uc_mmio_map(engine_, address, size, Hooks::read, user, Hooks::write, user), "uc_mmio_map");
}

// The engine asks before each access of a page without rights, and no other access gets slower.
void CortexM4::mapBorder(std::uint32_t address) {
  borderAt_ = address;
  mapMemory(address - kPage, kPage, UC_PROT_NONE, Access::ReadWrite);
}

void CortexM4::load(std::uint32_t address, std::span<const std::uint8_t> bytes) {
  check(uc_mem_write(engine_, address, bytes.data(), bytes.size()), "uc_mem_write");
  check(uc_ctl_remove_cache(engine_, address, address + bytes.size()), "uc_ctl_remove_cache");
}

// The place of bytes that lie in one memory; none where there is no memory.
std::uint8_t* CortexM4::at(std::uint32_t address, std::uint32_t size) const {
  for (const Memory& memory : memories_) {
    const std::uint32_t offset = address - memory.address;
    if (offset < memory.size && memory.size - offset >= size) {
      return memory.bytes.get() + offset;
    }
  }
  return nullptr;
}

template <typename Value>
Value CortexM4::load(std::uint32_t address) const {
  static_assert(std::endian::native == std::endian::little, "as the processor");
  Value value = 0;
  if (const std::uint8_t* place = at(address, sizeof value); place != nullptr) {
    std::memcpy(&value, place, sizeof value);
  }
  return value;
}

std::uint32_t CortexM4::word(std::uint32_t address) const {
  return load<std::uint32_t>(address);
}

std::uint16_t CortexM4::halfword(std::uint32_t address) const {
  return load<std::uint16_t>(address);
}

std::uint32_t CortexM4::reg(int id) const {
  std::uint32_t value = 0;
  uc_reg_read(engine_, id, &value);
  return value;
}

void CortexM4::setReg(int id, std::uint32_t value) const {
  uc_reg_write(engine_, id, &value);
}

// Many registers in one call are much faster than one by one.
template <std::size_t Count>
std::array<std::uint32_t, Count> CortexM4::regs(std::array<int, Count> ids) const {
  std::array<std::uint32_t, Count> values{};
  std::array<void*, Count> places{};
  std::ranges::transform(values, places.begin(), [](std::uint32_t& value) { return &value; });
  uc_reg_read_batch(engine_, ids.data(), places.data(), Count);
  return values;
}

// They are written in their order.
template <std::size_t Count>
void CortexM4::setRegs(std::array<int, Count> ids, std::array<std::uint32_t, Count> values) const {
  std::array<void*, Count> places{};
  std::ranges::transform(values, places.begin(), [](std::uint32_t& value) { return &value; });
  uc_reg_write_batch(engine_, ids.data(), places.data(), Count);
}

std::uint32_t CortexM4::core(unsigned number) const {
  return number == 13   ? reg(UC_ARM_REG_SP)
         : number == 14 ? reg(UC_ARM_REG_LR)
         : number == 15 ? pc()
                        : reg(UC_ARM_REG_R0 + static_cast<int>(number));
}

void CortexM4::setCore(unsigned number, std::uint32_t value) {
  setReg(number == 13   ? UC_ARM_REG_SP
         : number == 14 ? UC_ARM_REG_LR
         : number == 15 ? UC_ARM_REG_PC
                        : UC_ARM_REG_R0 + static_cast<int>(number),
         number == 15 ? value | 1U : value);
}

std::uint32_t CortexM4::pc() const {
  return running_ ? pc_ : reg(UC_ARM_REG_PC);
}

unsigned CortexM4::exception() const {
  return exception_;
}

std::uint64_t CortexM4::cycles() const {
  return cycles_;
}

std::uint64_t CortexM4::instructions() const {
  return cycles_ - otherCycles_;
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

void CortexM4::onBlock(std::function<void(std::uint32_t)> call) {
  blockCall_ = std::move(call);
  Hooks::add(*this, UC_HOOK_BLOCK, Hooks::block);
}

void CortexM4::reset() {
  nvic_.reset();
  system_.reset(cycles_);
  // In handler mode the program is privileged, so CONTROL can be cleared; in thread mode the stack
  // can be chosen.
  setReg(UC_ARM_REG_IPSR, kHardFault);
  setReg(UC_ARM_REG_APSR_NZCV, 0);
  setReg(UC_ARM_REG_CONTROL, 0);
  setReg(UC_ARM_REG_PRIMASK, 0);
  setReg(UC_ARM_REG_FAULTMASK, 0);
  setReg(UC_ARM_REG_BASEPRI, 0);
  setReg(UC_ARM_REG_IPSR, 0);
  exception_ = 0;
  setReg(UC_ARM_REG_CONTROL, 0);
  setReg(UC_ARM_REG_FPSCR, 0);
  setReg(UC_ARM_REG_SP, word(0) & ~3U);
  setReg(UC_ARM_REG_LR, 0xFFFFFFFF);
  setReg(UC_ARM_REG_XPSR_NZCVQG, kThumbBit);
  setReg(UC_ARM_REG_APSR_NZCV, 0);
  setReg(UC_ARM_REG_PC, word(4) | 1U);
  sleeping_ = false;
  raised_ = 0;
  refused_.reset();
  resumed_ = false;
  if ((word(4) & 1U) == 0) {
    report("vector-missing", "the vector of reset is " + hex(word(4)));
  }
}

void CortexM4::limitTo(std::uint64_t cycle) {
  limit_ = std::min(limit_, cycle);
  stopAt_ = std::min(stopAt_, limit_);
}

void CortexM4::exit() {
  exit_ = true;
  stop();
}

void CortexM4::skipTo(std::uint64_t cycle) {
  const std::uint64_t before = cycles_;
  cycles_ = std::max(cycles_, cycle);
  otherCycles_ += cycles_ - before;
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

void CortexM4::refuse(std::uint32_t address, std::string id, std::string what) {
  if (faultsAreProblems_) {
    report(std::move(id), std::move(what));
  } else if (!refused_) {
    refused_ = Refused{address, std::move(id), std::move(what)};
  }
  reevaluate();
}

int CortexM4::executionPriority(bool withPrimask) const {
  // ARMv7-M ARM, B1.5.4
  const auto [boosted, primask, faultmask] =
      regs<3>({UC_ARM_REG_BASEPRI, UC_ARM_REG_PRIMASK, UC_ARM_REG_FAULTMASK});
  int priority = nvic_.activePriority();
  const std::uint32_t basepri = boosted & 0xF0U;
  if (basepri != 0) {
    priority = std::min(priority, nvic_.group(static_cast<int>(basepri)));
  }
  if (withPrimask && (primask & 1U) != 0) {
    priority = std::min(priority, 0);
  }
  if ((faultmask & 1U) != 0) {
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
    system_.advance(cycles_);
    takePending();
    if (problem_) {
      return Stop::Problem;
    }
    if (cycles_ >= limit_) {
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
  maskedPending_ = false;
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
  // After an entry the next one may preempt before its first instruction: that of a late arrival.
  while (enterNext()) {
  }
}

// Enters the first pending exception if its turn has come.
bool CortexM4::enterNext() {
  const unsigned next = nvic_.first();
  if (next == 0) {
    return false;
  }
  const int wanted = nvic_.group(nvic_.priority(next));
  if (wanted >= nvic_.activePriority()) {
    return false;  // until an exception returns or a register of the NVIC is written
  }
  // WFI ends also for an interrupt that PRIMASK alone keeps away: ARMv7-M ARM, B1.5.18.
  if (sleeping_) {
    sleeping_ = wanted >= executionPriority(false);
  }
  if (wanted >= executionPriority()) {
    maskedPending_ = true;  // until the program changes a mask, which only the program sees
    return false;
  }
  enter(next, pc());
  return true;
}

// What the hook of each instruction does when there is more to do than to count it.
void CortexM4::lookAt(uc_struct* engine) {
  if (cycles_ >= stopAt_ || (careful_ && !mayRun(pc_))) {
    // The engine may go on to the end of an IT block and call again, so this must stay so.
    stopAt_ = 0;
    stoppedByHook_ = true;
    uc_emu_stop(engine);
    return;
  }
  ++cycles_;
  if (executed_ != nullptr) {
    executed_->note(pc_);
  }
}

bool CortexM4::mayRun(std::uint32_t address) {
  if (maskedPending_) {
    const unsigned next = nvic_.first();
    if (next != 0 && nvic_.group(nvic_.priority(next)) < executionPriority()) {
      return false;
    }
  }
  if (!system_.fpuOn()) {
    // Instructions of coprocessors 10 and 11, which are the FPU: ARMv7-M ARM, A5.3.18.
    const std::uint16_t first = halfword(address);
    if ((first & 0xEC00U) == 0xEC00U && (halfword(address + 2) >> 9 & 7U) == 5) {
      interrupt_ = kEngineUndefined;
      return false;
    }
  }
  return true;
}

void CortexM4::execute() {
  stopAt_ = std::min(limit_, system_.nextEvent());
  careful_ = maskedPending_ || !system_.fpuOn();
  looks_ = careful_ || executed_ != nullptr;
  stoppedByHook_ = false;
  interrupt_ = -1;
  badAccess_ = -1;
  pc_ = reg(UC_ARM_REG_PC);
  running_ = true;
  const uc_err error = uc_emu_start(engine_, pc_ | 1U, 0, 0, 0);
  running_ = false;
  resumed_ = blockCall_ != nullptr;
  stopped(error);
}

void CortexM4::stopped(int error) {
  const std::uint32_t at = pc();
  if (problem_) {
    return;
  }
  if (refused_) {
    const Refused refused = *std::exchange(refused_, std::nullopt);
    system_.noteBusAddress(refused.address);
    fault(kBusFault, SystemControl::kPreciseBus, pc_, refused.id, refused.what);
    return;
  }
  if (badAccess_ >= 0) {
    badAccess();
    return;
  }
  switch (interrupt_) {
    case kEngineReturn:
      exceptionReturn(at | 1U);
      return;
    case kEngineCall:
      supervisorCall(at);
      return;
    case kEngineBreakpoint:
      breakpoint(at);
      return;
    case kEngineNoExecution:
      fault(kMemoryFault, SystemControl::kInstructionViolation, at, "unhandled-fault",
            "execution at " + hex(at) + ", where no code is allowed");
      return;
    case kEngineUndefined:
      if (!system_.fpuOn() && stoppedByHook_) {
        fault(kUsageFault, SystemControl::kNoCoprocessor, at, "fpu-off",
              "floating-point instruction while the FPU is off");
        return;
      }
      break;
    default:
      break;
  }
  if (stoppedByHook_) {
    return;
  }
  if (error == UC_ERR_OK || error == UC_ERR_INSN_INVALID || error == UC_ERR_EXCEPTION) {
    hint(at);
    return;
  }
  report("unhandled-fault",
         std::string("the engine ended with: ") + uc_strerror(static_cast<uc_err>(error)));
}

// WFI ends the run with the program counter past it; WFE and YIELD look like invalid instructions,
// also with the program counter past them.
void CortexM4::hint(std::uint32_t past) {
  const std::uint16_t before = halfword(past - 2);
  if (pc_ == past - 2 && before == kWfi) {
    if (system_.sleepsDeep()) {
      report("unmodelled-register", "WFI with SCR.SLEEPDEEP: stop modes are not modelled");
    }
    sleeping_ = true;
    return;
  }
  if (pc_ == past - 2 && (before == kWfe || before == kYield)) {
    return;  // WFE may end at any time: ARMv7-M ARM, B1.5.17
  }
  fault(kUsageFault, SystemControl::kUndefined, past, "unhandled-fault",
        "undefined instruction " + hex(halfword(past)));
}

void CortexM4::badAccess() {
  const std::string address = hex(badAddress_);
  switch (badAccess_) {
    case UC_MEM_FETCH_UNMAPPED:
      fault(kBusFault, SystemControl::kInstructionBus, badAddress_, "unmapped-memory",
            "execution at " + address);
      return;
    case UC_MEM_FETCH_PROT:
      fault(kMemoryFault, SystemControl::kInstructionViolation, badAddress_, "unhandled-fault",
            "execution at " + address + ", where no code is allowed");
      return;
    case UC_MEM_WRITE_PROT:
      system_.noteBusAddress(badAddress_);
      fault(kBusFault, SystemControl::kPreciseBus, pc_, "flash-store", "store to " + address);
      return;
    default:
      system_.noteBusAddress(badAddress_);
      fault(kBusFault, SystemControl::kPreciseBus, pc_, "unmapped-memory",
            (badAccess_ == UC_MEM_WRITE_UNMAPPED ? "store to " : "load from ") + address);
      return;
  }
}

void CortexM4::fault(unsigned exception, std::uint32_t status, std::uint32_t pc,
                     const std::string& id, const std::string& what) {
  system_.noteFault(status);
  if (faultsAreProblems_) {
    setReg(UC_ARM_REG_PC, pc | 1U);
    report(id, what);
    return;
  }
  deliver(exception, pc);
}

// ARMv7-M ARM, B1.5.14: a fault that may not be taken becomes a HardFault; a HardFault that may not
// be taken locks up the processor.
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
  setReg(UC_ARM_REG_PC, pc | 1U);
  if (lockupCall_) {
    lockupCall_();
    stop();
  } else {
    report("lockup", "a fault in the handler of a fault");
  }
}

void CortexM4::supervisorCall(std::uint32_t past) {
  deliver(kSupervisorCall, past);
}

void CortexM4::breakpoint(std::uint32_t at) {
  constexpr std::uint16_t kSemihosting = 0xBEAB;
  if (halfword(at) == kSemihosting && semihosting_) {
    semihosting_(*this);
    setReg(UC_ARM_REG_PC, (at + 2) | 1U);
    return;
  }
  system_.noteHardFault(SystemControl::kDebugEvent);
  fault(kHardFault, 0, at, "unhandled-fault", "breakpoint");
}

// The memory of a word of the stack, or none.
std::uint8_t* CortexM4::stackAt(std::uint32_t address) const {
  for (const Memory& memory : memories_) {
    if (memory.access != Access::ReadExecute && address - memory.address < memory.size) {
      return memory.bytes.get() + (address - memory.address);
    }
  }
  return nullptr;
}

bool CortexM4::push(std::uint32_t address, std::span<const std::uint32_t> words) const {
  for (std::uint32_t i = 0; i < words.size(); ++i) {
    std::uint8_t* place = stackAt(address + 4 * i);
    if (place == nullptr) {
      return false;
    }
    std::memcpy(place, &words[i], sizeof words[i]);
  }
  return true;
}

bool CortexM4::pop(std::uint32_t address, std::span<std::uint32_t> words) const {
  for (std::uint32_t i = 0; i < words.size(); ++i) {
    const std::uint8_t* place = stackAt(address + 4 * i);
    if (place == nullptr) {
      return false;
    }
    std::memcpy(&words[i], place, sizeof words[i]);
  }
  return true;
}

// ARMv7-M ARM, B1.5.6: PushStack. The floating-point registers are stacked at once.
bool CortexM4::stack(std::uint32_t returnsTo, std::uint32_t& link) {
  const auto now =
      regs<9>({UC_ARM_REG_R0, UC_ARM_REG_R1, UC_ARM_REG_R2, UC_ARM_REG_R3, UC_ARM_REG_R12,
               UC_ARM_REG_LR, UC_ARM_REG_SP, UC_ARM_REG_XPSR, UC_ARM_REG_CONTROL});
  const std::uint32_t before = now[6];
  const std::uint32_t control = now[8];
  const unsigned from = exception();
  const bool withFp = (control & kFpActive) != 0 && system_.fpuStacks();
  const bool process = from == 0 && (control & kProcessStack) != 0;
  const bool align = system_.alignsStack() || withFp;
  const std::uint32_t size = withFp ? 0x68 : 0x20;
  const std::uint32_t frame = (before - size) & (align ? ~7U : ~3U);
  std::array<std::uint32_t, 26> words{};
  std::copy_n(now.begin(), 6, words.begin());
  words[6] = returnsTo & ~1U;
  words[7] = (now[7] & ~kAlignedBit) | (align && (before & 4U) != 0 ? kAlignedBit : 0);
  if (withFp) {
    for (int i = 0; i < 16; ++i) {
      words[8U + static_cast<unsigned>(i)] = reg(UC_ARM_REG_S0 + i);
    }
    words[24] = reg(UC_ARM_REG_FPSCR);
  }
  link = 0xFFFFFFE1U | (withFp ? 0 : 0x10U) | (from == 0 ? 8U : 0) | (process ? 4U : 0);
  const bool stacked = push(frame, std::span(words).first(size / 4));
  setReg(UC_ARM_REG_SP, frame);
  return stacked;
}

void CortexM4::enter(unsigned exception, std::uint32_t returnsTo) {
  pass(kEntryCycles);
  sleeping_ = false;
  std::uint32_t link = 0;
  if (!stack(returnsTo, link)) {
    const std::string what = "no memory for the frame of exception " + std::to_string(exception) +
                             " at " + hex(reg(UC_ARM_REG_SP));
    system_.noteFault(SystemControl::kStackingBus);
    if (faultsAreProblems_) {
      report("unmapped-memory", what);
      return;
    }
    // The fault that stacking met is taken in place of the exception, which stays pending. A
    // handler of faults runs although its own frame is lost (ARM DDI 0337E, 5.12.1).
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
  vector(exception, link);
}

// ARMv7-M ARM, B1.5.6: ExceptionTaken.
void CortexM4::vector(unsigned exception, std::uint32_t link) {
  const std::uint32_t handler = word(system_.vectors() + 4 * exception);
  const bool storm = nvic_.entriesOfHighLine(exception) >= kStorm;
  nvic_.activate(exception);
  const auto [control, flags, fpStatus] =
      regs<3>({UC_ARM_REG_CONTROL, UC_ARM_REG_APSR_NZCV, UC_ARM_REG_FPSCR});
  // CONTROL is written before IPSR: in handler mode the stack could not be chosen. The write of
  // the flags makes the engine see the new IPSR.
  setReg(UC_ARM_REG_CONTROL, control & 1U);
  setRegs<4>({UC_ARM_REG_LR, UC_ARM_REG_IPSR, UC_ARM_REG_SP, UC_ARM_REG_APSR_NZCV},
             {link, exception, reg(UC_ARM_REG_SP), flags});
  setItBits(0);
  exception_ = exception;
  if (const std::uint32_t wanted = (fpStatus & ~0x07C00000U) | system_.fpDefaults();
      wanted != fpStatus) {
    setReg(UC_ARM_REG_FPSCR, wanted);
  }
  resumed_ = blockCall_ != nullptr;
  if ((handler & 1U) == 0) {
    report("vector-missing",
           "the vector of exception " + std::to_string(exception) + " is " + hex(handler));
    return;
  }
  setReg(UC_ARM_REG_PC, handler);
  if (exceptionCall_) {
    exceptionCall_(Step::Entered, exception);
  }
  if (storm) {
    report("interrupt-storm", "interrupt " + std::to_string(exception - kFirstLine) +
                                  " was entered " + std::to_string(kStorm) +
                                  " times and its line is still high");
  }
}

// A handler begins outside of any IT block, and a return goes on inside the block that was left. Of
// the registers of the engine only CPSR takes these bits.
void CortexM4::setItBits(std::uint32_t state) const {
  const std::uint32_t now = reg(UC_ARM_REG_CPSR);
  if (((now ^ state) & kItBits) != 0) {
    setReg(UC_ARM_REG_CPSR, (now & ~kItBits) | (state & kItBits));
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
  if (number != kNmi && reg(UC_ARM_REG_FAULTMASK) != 0) {
    setReg(UC_ARM_REG_FAULTMASK, 0);
  }
  if (exceptionCall_) {
    exceptionCall_(Step::Left, number);
  }
  const unsigned next = nvic_.first();
  if (next != 0 && nvic_.group(nvic_.priority(next)) < executionPriority()) {
    pass(kTailCycles);
    vector(next, link);
    return;
  }
  pass(kExitCycles);
  unstack(link);
}

// ARMv7-M ARM, B1.5.8: PopStack.
void CortexM4::unstack(std::uint32_t link) {
  const bool toThread = (link & 8U) != 0;
  const bool process = (link & 4U) != 0;
  const bool withFp = (link & 0x10U) == 0;
  const std::uint32_t frame = process ? reg(UC_ARM_REG_PSP) : reg(UC_ARM_REG_SP);
  std::array<std::uint32_t, 26> words{};
  const std::uint32_t size = withFp ? 0x68 : 0x20;
  const unsigned from = exception();
  if (!pop(frame, std::span(words).first(size / 4))) {
    fault(kBusFault, SystemControl::kUnstackingBus, link, "unmapped-memory",
          "no frame of exception " + std::to_string(from) + " at " + hex(frame));
    return;
  }
  const std::uint32_t state = words[7];
  const std::uint32_t number = state & 0x1FFU;
  if (toThread != (number == 0) || (state & kThumbBit) == 0) {
    fault(kUsageFault,
          (state & kThumbBit) == 0 ? SystemControl::kInvalidState : SystemControl::kInvalidPc,
          words[6], "unhandled-fault",
          "return from exception " + std::to_string(from) + " to the state " + hex(state));
    return;
  }
  if (withFp) {
    for (int i = 0; i < 16; ++i) {
      setReg(UC_ARM_REG_S0 + i, words[8U + static_cast<unsigned>(i)]);
    }
    setReg(UC_ARM_REG_FPSCR, words[24]);
  }
  const std::uint32_t control =
      (reg(UC_ARM_REG_CONTROL) & 1U) | (process ? kProcessStack : 0) | (withFp ? kFpActive : 0);
  const bool aligned = (state & kAlignedBit) != 0 && (system_.alignsStack() || withFp);
  const std::uint32_t stack = (frame + size) | (aligned ? 4U : 0);
  // XPSR would leave out GE.
  setRegs<12>({UC_ARM_REG_R0, UC_ARM_REG_R1, UC_ARM_REG_R2, UC_ARM_REG_R3, UC_ARM_REG_R12,
               UC_ARM_REG_LR, UC_ARM_REG_IPSR, UC_ARM_REG_CONTROL, UC_ARM_REG_SP,
               UC_ARM_REG_XPSR_NZCVQG, UC_ARM_REG_APSR_NZCV, UC_ARM_REG_PC},
              {words[0], words[1], words[2], words[3], words[4], words[5], number, control, stack,
               state, state, words[6] | 1U});
  setItBits(state);
  exception_ = number;
  sleeping_ = toThread && system_.sleepsOnExit();
}

}  // namespace wr::k64
