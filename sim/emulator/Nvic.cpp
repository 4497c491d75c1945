#include "sim/emulator/Nvic.hpp"

#include <bit>

namespace wr::emulator {

namespace {

constexpr unsigned kFirstLine = 16;

// Offsets from 0xE000E000 (ARMv7-M ARM, B3.4.3, table of the NVIC registers).
constexpr std::uint32_t kSetEnable = 0x100;  // ISER
constexpr std::uint32_t kClearEnable = 0x180;
constexpr std::uint32_t kSetPending = 0x200;  // ISPR
constexpr std::uint32_t kClearPending = 0x280;
constexpr std::uint32_t kActive = 0x300;
constexpr std::uint32_t kPriority = 0x400;  // IPR
constexpr std::uint32_t kPriorityEnd = 0x500;
constexpr std::uint32_t kTrigger = 0xF00;

// Calls a function with the number of each bit that is set, in ascending order.
template <std::size_t size, typename Call>
void forEach(const std::bitset<size>& bits, Call call) {
  constexpr unsigned kWord = 64;
  constexpr std::bitset<size> kLowest(~std::uint64_t{0});
  for (unsigned begin = 0; begin < size; begin += kWord) {
    for (std::uint64_t word = (bits >> begin & kLowest).to_ullong(); word != 0; word &= word - 1) {
      call(begin + static_cast<unsigned>(std::countr_zero(word)));
    }
  }
}

}  // namespace

Nvic::Nvic(unsigned lines, unsigned priorityBits)
    : lines_(lines), priorityMask_(static_cast<std::uint8_t>(0xFF00U >> priorityBits)) {
  reset();
}

void Nvic::reset() {
  enabled_.reset();
  for (unsigned exception = 2; exception < kFirstLine; ++exception) {
    enabled_.set(exception, exception < 4 || exception > 6);
  }
  pending_.reset();
  active_.reset();
  activeCount_ = 0;
  priorities_.fill(0);
  entries_.fill(0);
  priorityGroup_ = 0;
}

void Nvic::unpend(unsigned exception) {
  pending_.set(exception, level_[exception] && !active_[exception]);
}

void Nvic::activate(unsigned exception) {
  pending_.reset(exception);
  activeCount_ += active_[exception] ? 0U : 1U;
  active_.set(exception);
  ++entries_[exception];
}

void Nvic::deactivate(unsigned exception) {
  activeCount_ -= active_[exception] ? 1U : 0U;
  active_.reset(exception);
  if (level_[exception]) {
    pending_.set(exception);
  }
}

bool Nvic::setLine(unsigned line, bool high) {
  const unsigned exception = kFirstLine + line;
  const bool rises = high && !level_[exception];
  if (rises) {
    pending_.set(exception);
    entries_[exception] = 0;
  }
  level_.set(exception, high);
  return rises;
}

unsigned Nvic::entriesOfHighLine(unsigned exception) const {
  return level_[exception] ? entries_[exception] : 0;
}

// Searches all pending and enabled exceptions. This search is fast, because only a few exceptions
// are pending and enabled at the same time.
unsigned Nvic::search() const {
  const Bits ready = pending_ & enabled_;
  unsigned best = 0;
  int bestPriority = kThreadPriority;
  forEach(ready, [&](unsigned exception) {
    if (priority(exception) < bestPriority) {
      best = exception;
      bestPriority = priority(exception);
    }
  });
  return best;
}

int Nvic::activePriority() const {
  int highest = kThreadPriority;
  if (activeCount_ == 0) {
    return highest;
  }
  forEach(active_, [&](unsigned exception) {
    const int own = group(priority(exception));
    highest = own < highest ? own : highest;
  });
  return highest;
}

void Nvic::setPriority(unsigned exception, std::uint8_t value) {
  priorities_[exception] = value & priorityMask_;
}

std::uint8_t Nvic::priorityByte(unsigned exception) const {
  return priorities_[exception];
}

bool Nvic::owns(std::uint32_t offset) {
  const bool bits = offset >= kSetEnable && offset < kActive + 0x40 && (offset & 0x7F) < 0x20;
  return bits || (offset >= kPriority && offset < kPriorityEnd) || offset == kTrigger;
}

std::uint32_t Nvic::wordOf(const Bits& bits, std::uint32_t offset) const {
  std::uint32_t word = 0;
  const std::uint32_t from = (offset & 0x1FU) * 8;
  for (std::uint32_t i = 0; i < 32 && from + i < lines_; ++i) {
    word |= bits[kFirstLine + from + i] ? 1U << i : 0;
  }
  return word;
}

std::uint32_t Nvic::read(std::uint32_t offset) const {
  if (offset >= kPriority) {
    std::uint32_t word = 0;
    const std::uint32_t line = offset - kPriority;
    for (std::uint32_t i = 0; i < 4 && offset < kPriorityEnd && line + i < lines_; ++i) {
      word |= std::uint32_t{priorities_[kFirstLine + line + i]} << 8 * i;
    }
    return word;
  }
  return offset < kSetPending ? wordOf(enabled_, offset)
         : offset < kActive   ? wordOf(pending_, offset)
                              : wordOf(active_, offset);
}

template <typename Call>
void Nvic::forEachLine(std::uint32_t offset, std::uint32_t value, Call call) {
  const std::uint32_t from = (offset & 0x1FU) * 8;
  for (std::uint32_t i = 0; i < 32 && from + i < lines_; ++i) {
    if ((value >> i & 1U) != 0) {
      call(kFirstLine + from + i);
    }
  }
}

bool Nvic::write(std::uint32_t offset, unsigned size, std::uint32_t value) {
  if (offset >= kPriority && offset < kPriorityEnd) {
    for (std::uint32_t i = 0; i < size && offset - kPriority + i < lines_; ++i) {
      setPriority(kFirstLine + offset - kPriority + i, static_cast<std::uint8_t>(value >> 8 * i));
    }
    return true;
  }
  if (size != 4) {
    return false;
  }
  if (offset == kTrigger) {
    pend(kFirstLine + (value & 0x1FFU) % lines_);
  } else if (offset < kClearEnable) {
    forEachLine(offset, value, [this](unsigned exception) { enabled_.set(exception); });
  } else if (offset < kSetPending) {
    forEachLine(offset, value, [this](unsigned exception) { enabled_.reset(exception); });
  } else if (offset < kClearPending) {
    forEachLine(offset, value, [this](unsigned exception) { pend(exception); });
  } else if (offset < kActive) {
    forEachLine(offset, value, [this](unsigned exception) { unpend(exception); });
  } else {
    return false;
  }
  return true;
}

}  // namespace wr::emulator
