#include "sim/emulator/processor/Core.hpp"

#include <algorithm>
#include <utility>

#include "sim/emulator/processor/Encoding.hpp"

namespace wr::emulator {

namespace {

// Returns true if an address is in the range in which no code may be executed (ARMv7-M ARM, B3.1).
bool isNeverExecuted(std::uint32_t address) {
  return (address >= 0x40000000 && address < 0x60000000) || address >= 0xA0000000;
}

bool isWide(std::uint32_t firstHalf) {
  return firstHalf >> 11 >= 0b11101;
}

}  // namespace

void Core::branchAndExchange(std::uint32_t address) {
  if (registers.exception != 0 && address >> 28 == 0xF) {
    trap(Trap::ExceptionReturn, address);
    next = address & ~1U;
    return;
  }
  branchOnly(address);
}

void Core::branchOnly(std::uint32_t address) {
  branch(address);
  if ((address & 1U) == 0) {
    registers.thumb = false;
    trap(Trap::InvalidState);
  }
}

bool Core::beginFp() {
  if (!fpu.on) {
    trap(Trap::FpuOff);
    return false;
  }
  if (fpu.activates && (registers.control & Registers::kFpActive) == 0) {
    registers.fpscr = (registers.fpscr & ~0x07C00000U) | fpu.defaults;
    registers.control |= Registers::kFpActive;
  }
  return true;
}

Trap Core::run() {
  const bool looks = executed_ != nullptr || blockCall_ != nullptr || lowestStack_ != nullptr ||
                     instructionCall_ != nullptr;
  if (slowFlash_) {
    looks ? runInstructions<true, true>() : runInstructions<true, false>();
  } else {
    looks ? runInstructions<false, true>() : runInstructions<false, false>();
  }
  return std::exchange(trap_, Trap::None);
}

// The address and the number of instructions are local variables. They are also copied to members
// of this class. The address is read from its member only after a branch and after a callback. A
// read at each instruction would be slow, because the processor of the host would have to wait for
// the previous instruction. An if statement selects the next address, because the processor of the
// host can predict the branch of an if statement.
template <bool kSlowFlash, bool kLooks>
void Core::runInstructions() {
  std::uint32_t address = next;
  const Instruction* place = placeOf(address);
  std::uint64_t begun = instructions_;
  while (begun + otherCycles_ < stopAt_) {
    registers.r[Registers::kPc] = address + 4;
    if constexpr (kLooks) {
      if (instructionCall_) {
        next = address;
        instructionCall_();
        address = next;
        place = placeOf(address);
      }
    }
    if (!place->isDecoded(registers.it != 0)) [[unlikely]] {
      place = decodeAt(address);
      if (place == nullptr) {
        return;
      }
    }
    const Instruction& instruction = *place;
    if constexpr (kSlowFlash) {
      fetchSlowly(address, instruction.bytes());
    }
    instructions_ = ++begun;
    if constexpr (kLooks) {
      note(address);
    }
    if (instruction.isWide()) {
      address += 4;
      place += 2;
      next = address;
      execute(instruction);
    } else {
      address += 2;
      place += 1;
      next = address;
      execute(instruction);
    }
    if (branched_) {
      if constexpr (!kLooks) {
        branched_ = false;
      }
      address = next;
      place = placeOf(address);
    }
  }
}

inline void Core::execute(const Instruction& instruction) {
  if (registers.it == 0) [[likely]] {
    instruction.run(*this, instruction);
  } else {
    executeInBlock(instruction);
  }
}

void Core::executeInBlock(const Instruction& instruction) {
  const std::uint8_t block = registers.it;
  registers.advanceIt();
  if (instruction.isUnconditional() || registers.passes(block >> 4U)) {
    instruction.run(*this, instruction);
    if (trap_ >= Trap::Breakpoint) {
      registers.it = block;
    }
  }
}

void Core::note(std::uint32_t address) {
  if (std::exchange(branched_, false) && blockCall_) {
    blockCall_(address);
  }
  if (executed_ != nullptr && (registers.it == 0 || registers.passes(registers.it >> 4U))) {
    executed_->note(address);
  }
  if (lowestStack_ != nullptr) {
    *lowestStack_ = std::min(*lowestStack_, registers.r[Registers::kStack]);
  }
}

// Returns the entry of an address in the table of decoded instructions.
inline const Instruction* Core::placeOf(std::uint32_t address) const {
  const std::uint32_t offset = address - codeAddress_;
  return offset < codeSize_ ? code_ + offset / 2 : &none_;
}

bool Core::fetchHalf(std::uint32_t address, std::uint32_t& half) {
  const Memory::Area* area = memory.find(address);
  if (isNeverExecuted(address) || (area != nullptr && !area->mayExecute)) {
    trap(Trap::InstructionViolation, address);
    return false;
  }
  if (area == nullptr) {
    trap(Trap::InstructionBus, address);
    return false;
  }
  half = memory.read<std::uint16_t>(address);
  return true;
}

const Instruction* Core::decodeAt(std::uint32_t address) {
  std::uint32_t first = 0;
  if (!fetchHalf(address, first)) {
    return nullptr;
  }
  const Memory::Area* area = memory.find(address);
  codeAddress_ = area->address;
  codeSize_ = area->size;
  code_ = area->instructions.get();
  codeIsSlow_ = area->isFlash();
  Instruction* place = code_ + (address - codeAddress_) / 2;
  const bool inBlock = registers.it != 0;
  if (place->isDecoded(inBlock)) {
    return place;
  }
  std::uint32_t bits = first;
  if (isWide(first)) {
    std::uint32_t second = 0;
    if (!fetchHalf(address + 2, second)) {
      return nullptr;
    }
    bits = first << 16 | second;
  }
  memory.decoded(address);
  *place = decode({.bits = bits, .inBlock = inBlock}, isWide(first));
  place->form |= static_cast<std::uint8_t>(Instruction::place(inBlock) | (isWide(first) ? 4U : 2U));
  return place;
}

void Core::fetchSlowly(std::uint32_t address, std::uint32_t size) {
  for (std::uint32_t at = address; at != address + size; at += 2) {
    const std::uint32_t phrase = at & ~(kPhrase - 1);
    if (phrase != phrase_ && codeIsSlow_ && at - codeAddress_ < codeSize_) {
      phrase_ = phrase;
      spend(kFlashCycles);
    }
  }
}

void Core::spendForRead(std::uint32_t address) {
  if (const Memory::Area* area = memory.find(address);
      slowFlash_ && area != nullptr && area->isFlash()) {
    spend(kFlashCycles);
  }
}

bool Core::loadAligned(std::uint32_t address, std::uint32_t& value) {
  if ((address & 3U) != 0) {
    trap(Trap::Unaligned);
    return false;
  }
  return load<std::uint32_t>(address, value);
}

bool Core::storeAligned(std::uint32_t address, std::uint32_t value) {
  if ((address & 3U) != 0) {
    trap(Trap::Unaligned);
    return false;
  }
  return store<std::uint32_t>(address, value);
}

bool Core::loadWords(std::uint32_t address, std::span<std::uint32_t> words) {
  const auto size = static_cast<std::uint32_t>(words.size_bytes());
  if (const std::uint8_t* bytes = memory.loadable(address, size); bytes != nullptr) {
    std::memcpy(words.data(), bytes, size);
    return true;
  }
  return std::ranges::all_of(words, [this, &address](std::uint32_t& word) {
    return loadAligned(std::exchange(address, address + 4), word);
  });
}

bool Core::storeWords(std::uint32_t address, std::span<const std::uint32_t> words) {
  const auto size = static_cast<std::uint32_t>(words.size_bytes());
  if (std::uint8_t* bytes = memory.storable(address, size); bytes != nullptr) {
    std::memcpy(bytes, words.data(), size);
    return true;
  }
  return std::ranges::all_of(words, [this, &address](std::uint32_t word) {
    return storeAligned(std::exchange(address, address + 4), word);
  });
}

// An unaligned access is split into two or three aligned accesses (Cortex-M4 TRM, 3.3.3).
bool Core::unalignedIsFine(const Memory::Area* area, std::uint32_t address, std::uint32_t size) {
  const std::uint32_t odd = address & (size - 1);
  if (odd == 0) {
    return true;
  }
  if (trapsUnaligned || area->bytes == nullptr) {  // a window is device memory (A3.2.1)
    trap(Trap::Unaligned);
    return false;
  }
  spend((odd & 1U) != 0 && size == 4 ? 2 : 1);
  return true;
}

bool Core::loadElsewhere(std::uint32_t address, std::uint32_t size, std::uint32_t& value) {
  const Memory::Area* area = memory.find(address);
  if (area == nullptr) {
    trap(Trap::LoadBus, address);
    return false;
  }
  if (!unalignedIsFine(area, address, size)) {
    return false;
  }
  if (area->bytes == nullptr) {
    value = area->read(address, size);
    memory.accessed(address, size, false);
    return trap_ == Trap::None;
  }
  if (!area->holds(address, size)) {
    trap(memory.find(address + (size - 1)) == nullptr ? Trap::LoadBus : Trap::LoadAcross, address);
    return false;
  }
  value = 0;
  std::memcpy(&value, area->at(address), size);
  memory.accessed(address, size, false);
  spendForRead(address);
  if (((address ^ (address + (size - 1))) & ~3U) != 0) {
    spendForRead(address + (size - 1));
  }
  return true;
}

bool Core::storeElsewhere(std::uint32_t address, std::uint32_t size, std::uint32_t value) {
  const Memory::Area* area = memory.find(address);
  if (area == nullptr) {
    trap(Trap::StoreBus, address);
    return false;
  }
  if (!unalignedIsFine(area, address, size)) {
    return false;
  }
  if (area->bytes == nullptr) {
    area->write(address, size, size == 4 ? value : value & ((1U << 8 * size) - 1));
    memory.accessed(address, size, true);
    return trap_ == Trap::None;
  }
  if (!area->mayWrite) {
    trap(Trap::FlashStore, address);
    return false;
  }
  if (!area->holds(address, size)) {
    trap(memory.find(address + (size - 1)) == nullptr ? Trap::StoreBus : Trap::StoreAcross,
         address);
    return false;
  }
  std::memcpy(area->at(address), &value, size);
  Memory::forget(*area, address, size);
  memory.accessed(address, size, true);
  return true;
}

}  // namespace wr::emulator
