#include "sim/emulator/processor/Reference.hpp"

#include <unicorn/unicorn.h>

#include <stdexcept>

namespace wr::emulator::reference {

namespace {

constexpr std::uint32_t kFlags = 0xF80F0000;
constexpr std::uint32_t kPage = 0x1000;

void check(uc_err error) {
  if (error != UC_ERR_OK) {
    throw std::runtime_error(uc_strerror(error));
  }
}

/// The registers of a state, and their names in the engine.
class Registers {
 public:
  explicit Registers(State& state) {
    for (int i = 0; i < 13; ++i) {
      add(UC_ARM_REG_R0 + i, state.core.at(static_cast<std::size_t>(i)));
    }
    add(UC_ARM_REG_SP, state.core[13]);
    add(UC_ARM_REG_LR, state.core[14]);
    add(UC_ARM_REG_PC, state.pc);
    for (int i = 0; i < 32; ++i) {
      add(UC_ARM_REG_S0 + i, state.single.at(static_cast<std::size_t>(i)));
    }
    add(UC_ARM_REG_FPSCR, state.fpscr);
  }

  void write(uc_engine* engine) {
    check(uc_reg_write_batch(engine, names_.data(), places_.data(), count()));
  }
  void read(uc_engine* engine) {
    check(uc_reg_read_batch(engine, names_.data(), places_.data(), count()));
  }

 private:
  void add(int name, std::uint32_t& place) {
    names_.push_back(name);
    places_.push_back(&place);
  }
  [[nodiscard]] int count() const { return static_cast<int>(names_.size()); }

  std::vector<int> names_;
  std::vector<void*> places_;
};

void interrupted(uc_engine* engine, std::uint32_t /*number*/, void* faulted) {
  *static_cast<bool*>(faulted) = true;
  uc_emu_stop(engine);
}

}  // namespace

UnicornCore::UnicornCore() {
  // The engine also has a mode for microcontrollers, but this mode would select a Cortex-M33.
  check(uc_open(UC_ARCH_ARM, UC_MODE_THUMB, &engine_));
  check(uc_ctl_set_cpu_model(engine_, UC_CPU_ARM_CORTEX_M4));
  check(uc_mem_map(engine_, kCode, kCodeSize, UC_PROT_ALL));
  check(uc_mem_map_ptr(engine_, kRam, kRamSize, UC_PROT_READ | UC_PROT_WRITE, ram_.data()));
  static_assert(kRamSize % kPage == 0);
  uc_hook hook{};
  check(uc_hook_add(engine_, &hook, UC_HOOK_INTR, reinterpret_cast<void*>(interrupted), &faulted_,
                    1, 0));
}

UnicornCore::~UnicornCore() {
  uc_close(engine_);
}

bool UnicornCore::execute(std::span<const std::uint8_t> code, State& state) {
  check(uc_mem_write(engine_, state.pc, code.data(), code.size()));
  check(uc_ctl_remove_cache(engine_, kCode, kCode + kCodeSize));
  Registers registers(state);
  registers.write(engine_);
  std::uint32_t flags = state.flags | 1U << 24;
  check(uc_reg_write(engine_, UC_ARM_REG_XPSR_NZCVQG, &flags));
  std::uint32_t control = 4;  // the floating-point unit is in use, so FPSCR keeps its value
  check(uc_reg_write(engine_, UC_ARM_REG_CONTROL, &control));
  faulted_ = false;
  const uc_err error = uc_emu_start(engine_, state.pc | 1U, state.pc + code.size(), 0,
                                    1 + (code[1] == 0xBF ? 1 : 0));
  registers.read(engine_);
  check(uc_reg_read(engine_, UC_ARM_REG_XPSR, &flags));
  state.flags = flags & kFlags;
  state.core[13] &= ~3U;  // the engine does not clear two bits that are always 0 in the processor
  return error == UC_ERR_OK && !faulted_;
}

}  // namespace wr::emulator::reference
