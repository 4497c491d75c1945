#include <array>
#include <bit>
#include <cstring>
#include <span>

#include "sim/emulator/processor/Core.hpp"
#include "sim/emulator/processor/Encoding.hpp"

// Loads and stores (ARMv7-M ARM, A5.2.4, A5.3.5 to A5.3.10).

namespace wr::emulator {

namespace {

/// The way in which an instruction computes its address.
enum class Place : std::uint8_t {
  Offset,   ///< register n plus value
  Before,   ///< register n plus value; register n is written back
  After,    ///< register n, to which `value` is added afterwards
  Indexed,  ///< register n plus register m, which is shifted to the left by value
  Literal   ///< the program counter plus value
};
constexpr std::size_t kPlaces = 5;

struct Addresses {
  std::uint32_t accessed;
  std::uint32_t kept;  ///< new value of register n
};

template <Place kPlace>
Addresses addresses(const Registers& x, const Instruction& in) {
  const std::uint32_t base = kPlace == Place::Literal ? x.r[Registers::kPc] & ~3U : x.r[in.n];
  const std::uint32_t moved = base + (kPlace == Place::Indexed ? x.r[in.m] << in.value : in.value);
  return {kPlace == Place::After ? base : moved, moved};
}

template <Place kPlace>
void keep(Registers& x, const Instruction& in, std::uint32_t address) {
  if constexpr (kPlace == Place::Before || kPlace == Place::After) {
    x.r[in.n] = in.n == Registers::kStack ? address & ~3U : address;
  }
}

template <typename Value, Place kPlace>
[[gnu::noinline]] void loadElsewhere(Core& core, const Instruction& in) {
  const Addresses address = addresses<kPlace>(core.registers, in);
  std::uint32_t value = 0;
  if (core.load<Value>(address.accessed, value)) {
    keep<kPlace>(core.registers, in, address.kept);
    core.registers.r[in.d] = value;
  }
}

// Loads a number. Some accesses need further function calls. A separate function executes these
// accesses. Therefore a direct access does not save registers for the calls.
template <typename Value, Place kPlace>
void load(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const Addresses address = addresses<kPlace>(x, in);
  core.spend(kAccessCycles);
  std::uint32_t value = 0;
  if (core.loadDirectly<Value>(address.accessed, value)) [[likely]] {
    keep<kPlace>(x, in, address.kept);
    x.r[in.d] = value;
    return;
  }
  loadElsewhere<Value, kPlace>(core, in);
}

template <Place kPlace>
void loadStack(Core& core, const Instruction& in) {
  load<std::uint32_t, kPlace>(core, in);
  core.registers.r[Registers::kStack] &= ~3U;
}

template <Place kPlace>
void loadPc(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const Addresses address = addresses<kPlace>(x, in);
  core.spend(kAccessCycles);
  std::uint32_t value = 0;
  if (core.loadAligned(address.accessed, value)) {
    keep<kPlace>(x, in, address.kept);
    core.branchAndExchange(value);
  }
}

template <typename Value, Place kPlace>
[[gnu::noinline]] void storeElsewhere(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const Addresses address = addresses<kPlace>(x, in);
  if (core.store<Value>(address.accessed, x.r[in.d])) {
    keep<kPlace>(x, in, address.kept);
  }
}

template <typename Value, Place kPlace>
void store(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const Addresses address = addresses<kPlace>(x, in);
  core.spend(kAccessCycles);
  if (core.storeDirectly<Value>(address.accessed, x.r[in.d])) [[likely]] {
    keep<kPlace>(x, in, address.kept);
    return;
  }
  storeElsewhere<Value, kPlace>(core, in);
}

// PLD and PLI have no effect, because there is no cache.
void preload(Core& /*core*/, const Instruction& /*in*/) {}

using Row = std::array<Instruction::Operation, kPlaces>;

template <typename Value>
constexpr Row kLoads{load<Value, Place::Offset>, load<Value, Place::Before>,
                     load<Value, Place::After>, load<Value, Place::Indexed>,
                     load<Value, Place::Literal>};

template <typename Value>
constexpr Row kStores{store<Value, Place::Offset>, store<Value, Place::Before>,
                      store<Value, Place::After>, store<Value, Place::Indexed>, nullptr};

constexpr Row kStackLoads{loadStack<Place::Offset>, loadStack<Place::Before>,
                          loadStack<Place::After>, loadStack<Place::Indexed>,
                          loadStack<Place::Literal>};

constexpr Row kPcLoads{loadPc<Place::Offset>, loadPc<Place::Before>, loadPc<Place::After>,
                       loadPc<Place::Indexed>, loadPc<Place::Literal>};

/// Kind of an access. The values are the codes of opB in section A5.2.4 of the manual.
enum class Access : std::uint8_t {
  StoreWord,
  StoreHalf,
  StoreByte,
  LoadSignedByte,
  LoadWord,
  LoadHalf,
  LoadByte,
  LoadSignedHalf
};

Instruction::Operation operation(Access access, Place place) {
  static constexpr std::array<const Row*, 8> kRows{&kStores<std::uint32_t>, &kStores<std::uint16_t>,
                                                   &kStores<std::uint8_t>,  &kLoads<std::int8_t>,
                                                   &kLoads<std::uint32_t>,  &kLoads<std::uint16_t>,
                                                   &kLoads<std::uint8_t>,   &kLoads<std::int16_t>};
  return (*kRows[static_cast<std::size_t>(access)])[static_cast<std::size_t>(place)];
}

Instruction shortForm(Encoding code, Access access, std::uint32_t offset) {
  return {
      .run = operation(access, Place::Offset), .value = offset, .d = code.low(0), .n = code.low(3)};
}

Instruction ofStack(Encoding code) {
  return {.run = operation(code.bit(11) ? Access::LoadWord : Access::StoreWord, Place::Offset),
          .value = code.field(7, 0) * 4,
          .d = code.low(8),
          .n = Registers::kStack};
}

// A5.3.7 to A5.3.10: bits 24 (sign), 22 and 21 (size), 20 (load).
constexpr std::uint32_t kUnknown = 8;

std::uint32_t longAccess(Encoding code) {
  switch (code.field(24, 20) & 0b10111U) {
    case 0b00000:
      return static_cast<std::uint32_t>(Access::StoreByte);
    case 0b00010:
      return static_cast<std::uint32_t>(Access::StoreHalf);
    case 0b00100:
      return static_cast<std::uint32_t>(Access::StoreWord);
    case 0b00001:
      return static_cast<std::uint32_t>(Access::LoadByte);
    case 0b00011:
      return static_cast<std::uint32_t>(Access::LoadHalf);
    case 0b00101:
      return static_cast<std::uint32_t>(Access::LoadWord);
    case 0b10001:
      return static_cast<std::uint32_t>(Access::LoadSignedByte);
    case 0b10011:
      return static_cast<std::uint32_t>(Access::LoadSignedHalf);
    default:
      return kUnknown;
  }
}

struct LongPlace {
  bool known;
  Place place;
  std::uint32_t value;
};

LongPlace longPlace(Encoding code) {
  const std::uint32_t offset = code.field(11, 0);
  if (code.bit(20) && code.reg(16) == 15) {
    return {true, Place::Literal, code.bit(23) ? offset : 0 - offset};
  }
  if (code.bit(23)) {
    return {true, Place::Offset, offset};
  }
  if (!code.bit(11)) {
    return {code.field(10, 6) == 0, Place::Indexed, code.field(5, 4)};
  }
  const std::uint32_t byte = code.bit(9) ? code.field(7, 0) : 0 - code.field(7, 0);
  const bool before = code.bit(10);
  const bool keeps = code.bit(8);
  return {before || keeps, !before ? Place::After : keeps ? Place::Before : Place::Offset, byte};
}

// Two words, A5.3.6. Register m is the second register, and `value` is the offset.

template <bool kLoads, Place kPlace>
void dual(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const Addresses address = addresses<kPlace>(x, in);
  core.spend(2);
  if constexpr (kLoads) {
    std::uint32_t first = 0;
    std::uint32_t second = 0;
    if (!core.loadAligned(address.accessed, first) ||
        !core.loadAligned(address.accessed + 4, second)) {
      return;
    }
    keep<kPlace>(x, in, address.kept);
    x.r[in.d] = first;
    x.r[in.m] = second;
  } else if (core.storeAligned(address.accessed, x.r[in.d]) &&
             core.storeAligned(address.accessed + 4, x.r[in.m])) {
    keep<kPlace>(x, in, address.kept);
  }
}

template <bool kLoads>
Instruction::Operation dualOperation(bool before, bool keeps, bool literal) {
  return literal   ? dual<kLoads, Place::Literal>
         : !before ? dual<kLoads, Place::After>
         : keeps   ? dual<kLoads, Place::Before>
                   : dual<kLoads, Place::Offset>;
}

// Exclusive accesses, A3.4. Between a load and its store, only the handler of an exception can
// access the memory. The entry and the return of an exception clear the monitor.

template <typename Value>
bool aligned(Core& core, std::uint32_t address) {
  if ((address & (sizeof(Value) - 1)) != 0) {
    core.trap(Trap::Unaligned);
    return false;
  }
  return true;
}

template <typename Value>
void loadExclusive(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const std::uint32_t address = x.r[in.n] + in.value;
  core.spend(kAccessCycles);
  std::uint32_t value = 0;
  if (aligned<Value>(core, address) && core.load<Value>(address, value)) {
    core.exclusive = true;
    x.r[in.d] = value;
  }
}

// Writes 0 to register m if the value was stored, and 1 if the value was not stored.
template <typename Value>
void storeExclusive(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const std::uint32_t address = x.r[in.n] + in.value;
  core.spend(kAccessCycles);
  if (!aligned<Value>(core, address)) {
    return;
  }
  if (!core.exclusive) {
    x.r[in.m] = 1;
  } else if (core.store<Value>(address, x.r[in.d])) {
    core.exclusive = false;
    x.r[in.m] = 0;
  }
}

template <typename Value>
void tableBranch(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  core.spend(kAccessCycles);
  std::uint32_t entry = 0;
  if (core.load<Value>(x.r[in.n] + x.r[in.m] * std::uint32_t{sizeof(Value)}, entry)) {
    core.branch(x.r[Registers::kPc] + 2 * entry);
  }
}

Instruction exclusiveOrTable(Encoding code) {
  Instruction result{.d = code.reg(12), .n = code.reg(16), .m = code.reg(0)};
  if (code.field(24, 23) == 0) {
    result.run = code.bit(20) ? loadExclusive<std::uint32_t> : storeExclusive<std::uint32_t>;
    result.value = code.field(7, 0) * 4;
    result.m = code.reg(8);
    return result;
  }
  switch (code.field(20, 20) << 4 | code.field(7, 4)) {
    case 0x04:
      result.run = storeExclusive<std::uint8_t>;
      return result;
    case 0x05:
      result.run = storeExclusive<std::uint16_t>;
      return result;
    case 0x10:
      result.run = tableBranch<std::uint8_t>;
      return result;
    case 0x11:
      result.run = tableBranch<std::uint16_t>;
      return result;
    case 0x14:
      result.run = loadExclusive<std::uint8_t>;
      return result;
    case 0x15:
      result.run = loadExclusive<std::uint16_t>;
      return result;
    default:
      return undefined();
  }
}

// Several registers. The lower 16 bits of `value` are the list of registers, and `d` is the length
// of this list. If bit 16 of `value` is set, register n is written back.
constexpr std::uint32_t kKeeps = 1U << 16;
constexpr std::uint32_t kList = 0xFFFF;

template <bool kDown>
void loadMultiple(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const std::uint32_t base = x.r[in.n];
  const std::uint32_t size = 4U * in.d;
  const std::uint32_t first = kDown ? base - size : base;
  core.spend(in.d);
  std::array<std::uint8_t, 64> loaded;  // NOLINT(cppcoreguidelines-pro-type-member-init): loaded
  const std::uint8_t* next = core.memory.loadable(first, size);
  if (next == nullptr) [[unlikely]] {
    std::array<std::uint32_t, 16> words{};
    if (!core.loadWords(first, std::span(words).first(in.d))) {
      return;
    }
    loaded = std::bit_cast<decltype(loaded)>(words);
    next = loaded.data();
  }
  if ((in.value & kKeeps) != 0) {
    x.r[in.n] = kDown ? first : base + size;
  }
  for (std::uint32_t list = in.value & 0x7FFFU; list != 0; list &= list - 1) {
    std::memcpy(&x.r[static_cast<std::size_t>(std::countr_zero(list))], next, 4);
    next += 4;
  }
  if ((in.value & 1U << Registers::kPc) != 0) {
    std::uint32_t target = 0;
    std::memcpy(&target, next, sizeof target);
    core.branchAndExchange(target);
  }
}

template <bool kDown>
void storeMultiple(Core& core, const Instruction& in) {
  Registers& x = core.registers;
  const std::uint32_t base = x.r[in.n];
  const std::uint32_t size = 4U * in.d;
  const std::uint32_t first = kDown ? base - size : base;
  core.spend(in.d);
  std::array<std::uint8_t, 64> stored;  // NOLINT(cppcoreguidelines-pro-type-member-init): filled
  std::uint8_t* const direct = core.memory.storable(first, size);
  std::uint8_t* next = direct != nullptr ? direct : stored.data();
  for (std::uint32_t list = in.value & kList; list != 0; list &= list - 1) {
    std::memcpy(next, &x.r[static_cast<std::size_t>(std::countr_zero(list))], 4);
    next += 4;
  }
  if (direct == nullptr) [[unlikely]] {
    const auto words = std::bit_cast<std::array<std::uint32_t, 16>>(stored);
    if (!core.storeWords(first, std::span(words).first(in.d))) {
      return;
    }
  }
  if ((in.value & kKeeps) != 0) {
    x.r[in.n] = kDown ? first : base + size;
  }
}

Instruction multiple(Instruction::Operation run, std::uint8_t n, std::uint32_t value) {
  return {.run = run,
          .value = value,
          .d = static_cast<std::uint8_t>(std::popcount(value & kList)),
          .n = n};
}

}  // namespace

Instruction shortLoadStore(Encoding code) {
  const std::uint32_t offset = code.field(10, 6);
  const bool loads = code.bit(11);
  switch (code.field(15, 12)) {
    case 0b0100:
      return {.run = operation(Access::LoadWord, Place::Literal),
              .value = code.field(7, 0) * 4,
              .d = code.low(8)};
    case 0b0101:
      return {.run = operation(static_cast<Access>(code.field(11, 9)), Place::Indexed),
              .d = code.low(0),
              .n = code.low(3),
              .m = code.low(6)};
    case 0b0110:
      return shortForm(code, loads ? Access::LoadWord : Access::StoreWord, offset * 4);
    case 0b0111:
      return shortForm(code, loads ? Access::LoadByte : Access::StoreByte, offset);
    case 0b1000:
      return shortForm(code, loads ? Access::LoadHalf : Access::StoreHalf, offset * 2);
    default:
      return ofStack(code);
  }
}

Instruction loadStoreSingle(Encoding code) {
  const std::uint32_t access = longAccess(code);
  const auto [known, place, value] = longPlace(code);
  if (access == kUnknown || !known || (!code.bit(20) && code.reg(16) == 15)) {
    return undefined();
  }
  Instruction result{.run = operation(static_cast<Access>(access), place),
                     .value = value,
                     .d = code.reg(12),
                     .n = code.reg(16),
                     .m = code.reg(0)};
  const auto row = static_cast<std::size_t>(place);
  if (code.bit(20) && result.d == Registers::kPc) {
    result.run = static_cast<Access>(access) == Access::LoadWord ? kPcLoads[row] : preload;
  } else if (result.d == Registers::kStack && static_cast<Access>(access) == Access::LoadWord) {
    result.run = kStackLoads[row];
  }
  return result;
}

Instruction loadStoreDual(Encoding code) {
  const bool before = code.bit(24);
  const bool keeps = code.bit(21);
  if (!before && !keeps) {
    return exclusiveOrTable(code);
  }
  const std::uint32_t offset = code.field(7, 0) * 4;
  const bool literal = code.reg(16) == 15;
  if (literal && (!code.bit(20) || keeps)) {
    return undefined();
  }
  return {.run = code.bit(20) ? dualOperation<true>(before, keeps, literal)
                              : dualOperation<false>(before, keeps, false),
          .value = code.bit(23) ? offset : 0 - offset,
          .d = code.reg(12),
          .n = code.reg(16),
          .m = code.reg(8)};
}

Instruction shortLoadStoreMultiple(Encoding code) {
  const std::uint32_t list = code.field(7, 0);
  const bool loads = code.bit(11);
  if (code.field(15, 12) == 0b1011) {  // PUSH and POP
    const std::uint32_t last = code.bit(8) ? 1U << (loads ? Registers::kPc : Registers::kLink) : 0;
    return multiple(loads ? loadMultiple<false> : storeMultiple<true>, Registers::kStack,
                    kKeeps | list | last);
  }
  const std::uint8_t n = code.low(8);
  const bool keeps = !loads || (list >> n & 1U) == 0;
  return multiple(loads ? loadMultiple<false> : storeMultiple<false>, n,
                  list | (keeps ? kKeeps : 0));
}

Instruction loadStoreMultiple(Encoding code) {
  const unsigned direction = code.field(24, 23);
  const std::uint32_t value = code.field(15, 0) | (code.bit(21) ? kKeeps : 0);
  if (direction != 1 && direction != 2) {
    return undefined();
  }
  const bool down = direction == 2;
  if (code.bit(20)) {
    return multiple(down ? loadMultiple<true> : loadMultiple<false>, code.reg(16), value);
  }
  return multiple(down ? storeMultiple<true> : storeMultiple<false>, code.reg(16), value);
}

}  // namespace wr::emulator
