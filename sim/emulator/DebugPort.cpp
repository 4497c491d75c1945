#include "sim/emulator/DebugPort.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "sim/emulator/CortexM4.hpp"

namespace wr::emulator {

namespace {

constexpr std::size_t kState = 16;
constexpr std::size_t kMainStack = 17;
constexpr std::size_t kProcessStack = 18;
constexpr std::size_t kPrimask = 19;
constexpr std::size_t kBasepri = 20;
constexpr std::size_t kFaultmask = 21;
constexpr std::size_t kControl = 22;
constexpr std::size_t kFirstDouble = 23;
constexpr std::size_t kDoubles = 16;
constexpr std::size_t kFpscr = kFirstDouble + kDoubles;

// The registers in the order in which they are sent to the debugger.
constexpr auto kRegisters = std::to_array<DebugPort::Register>({
    {"r0", 32},  {"r1", 32},     {"r2", 32},     {"r3", 32},       {"r4", 32},     {"r5", 32},
    {"r6", 32},  {"r7", 32},     {"r8", 32},     {"r9", 32},       {"r10", 32},    {"r11", 32},
    {"r12", 32}, {"sp", 32},     {"lr", 32},     {"pc", 32},       {"xpsr", 32},   {"msp", 32},
    {"psp", 32}, {"primask", 8}, {"basepri", 8}, {"faultmask", 8}, {"control", 8}, {"d0", 64},
    {"d1", 64},  {"d2", 64},     {"d3", 64},     {"d4", 64},       {"d5", 64},     {"d6", 64},
    {"d7", 64},  {"d8", 64},     {"d9", 64},     {"d10", 64},      {"d11", 64},    {"d12", 64},
    {"d13", 64}, {"d14", 64},    {"d15", 64},    {"fpscr", 32},
});
static_assert(kRegisters.size() == kFpscr + 1);
static_assert(kRegisters[DebugPort::kPc].name == "pc");

// Returns the 32-bit register with the given number. The number is kFpscr, or lies between
// kMainStack and kControl.
std::uint32_t& special(Registers& x, std::size_t number) {
  switch (number) {
    case kMainStack:
      return x.mainStack();
    case kProcessStack:
      return x.processStack();
    case kPrimask:
      return x.primask;
    case kBasepri:
      return x.basepri;
    case kFaultmask:
      return x.faultmask;
    case kControl:
      return x.control;
    default:
      return x.fpscr;
  }
}

// Returns the size of the widest aligned access at an address. The size is at most the remaining
// number of bytes.
unsigned widest(std::uint32_t address, std::size_t left) {
  if (address % 4 == 0 && left >= 4) {
    return 4;
  }
  return address % 2 == 0 && left >= 2 ? 2 : 1;
}

}  // namespace

std::span<const DebugPort::Register> DebugPort::registers() {
  return kRegisters;
}

std::uint64_t DebugPort::read(std::size_t number) const {
  Registers& x = cpu_.registers();
  if (number < kState) {
    return cpu_.core(static_cast<unsigned>(number));
  }
  if (number == kState) {
    return x.state();
  }
  if (number >= kFirstDouble && number < kFpscr) {
    const std::size_t low = 2 * (number - kFirstDouble);
    return x.s.at(low) | std::uint64_t{x.s.at(low + 1)} << 32;
  }
  return special(x, number);
}

void DebugPort::write(std::size_t number, std::uint64_t value) {
  Registers& x = cpu_.registers();
  const auto word = static_cast<std::uint32_t>(value);
  if (number < kState) {
    cpu_.setCore(static_cast<unsigned>(number), word);
  } else if (number == kState) {
    x.setState(word);
  } else if (number >= kFirstDouble && number < kFpscr) {
    const std::size_t low = 2 * (number - kFirstDouble);
    x.s.at(low) = word;
    x.s.at(low + 1) = static_cast<std::uint32_t>(value >> 32);
  } else {
    special(x, number) = word;
  }
}

std::optional<std::uint32_t> DebugPort::inspect(std::uint32_t address, unsigned size) const {
  std::uint32_t value = 0;
  if (address >= 0xE0000000) {
    return size == 4 && cpu_.inspectSystem(address, value) ? std::optional(value) : std::nullopt;
  }
  return bus_.read(address, size, value) ? std::optional(value) : std::nullopt;
}

// The registers of a block differ in size. When an access is rejected because of its size, a
// narrower access is tried.
std::size_t DebugPort::readMemory(std::uint32_t address, std::span<std::uint8_t> bytes) const {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const std::uint32_t at = address + static_cast<std::uint32_t>(done);
    const Memory::Area* area = cpu_.memory().find(at);
    if (area == nullptr) {
      return done;
    }
    if (area->bytes != nullptr) {
      bytes[done++] = *area->at(at);
      continue;
    }
    unsigned size = widest(at, bytes.size() - done);
    std::optional<std::uint32_t> value = inspect(at, size);
    while (!value && size > 1) {
      size /= 2;
      value = inspect(at, size);
    }
    if (!value) {
      return done;
    }
    std::memcpy(&bytes[done], &*value, size);
    done += size;
  }
  return done;
}

bool DebugPort::writeMemory(std::uint32_t address, std::span<const std::uint8_t> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const std::uint32_t at = address + static_cast<std::uint32_t>(done);
    const Memory::Area* area = cpu_.memory().find(at);
    if (area == nullptr || at >= 0xE0000000) {
      return false;
    }
    if (area->bytes != nullptr) {
      const std::size_t room = area->size - (at - area->address);
      const auto part = bytes.subspan(done, std::min(room, bytes.size() - done));
      cpu_.load(at, part);
      done += part.size();
      continue;
    }
    const unsigned size = widest(at, bytes.size() - done);
    std::uint32_t value = 0;
    std::memcpy(&value, &bytes[done], size);
    if (!bus_.write(at, size, value)) {
      return false;
    }
    done += size;
  }
  return true;
}

void DebugPort::onInstruction(std::function<void()> call) {
  cpu_.onInstruction(std::move(call));
}

void DebugPort::onAccess(std::function<void(std::uint32_t, std::uint32_t, bool)> call) {
  cpu_.onAccess(std::move(call));
}

std::uint64_t DebugPort::instructions() const {
  return cpu_.instructions();
}

}  // namespace wr::emulator
