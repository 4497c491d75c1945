#include "sim/emulator/Pit.hpp"

#include <algorithm>

namespace wr::emulator {

namespace {

// Offsets from 0x40037000 (K64P144M120SF5RM, PIT memory map).
constexpr std::uint32_t kMcr = 0x000;
constexpr std::uint32_t kFirstChannel = 0x100;
constexpr std::uint32_t kEnd = 0x140;
constexpr std::uint32_t kLdval = 0x0;
constexpr std::uint32_t kCval = 0x4;
constexpr std::uint32_t kTctrl = 0x8;

constexpr std::uint32_t kStopped = 2;    // MCR.MDIS
constexpr std::uint32_t kInterrupt = 2;  // TCTRL.TIE
constexpr unsigned kFirstLine = 48;

}  // namespace

void Pit::reset(Reset /*cause*/) {
  channels_ = {};
  control_ = 0x6;
  controlRead_ = false;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    update(i);
  }
}

bool Pit::counts(const Channel& channel) const {
  return channel.enabled() && (control_ & kStopped) == 0;
}

std::uint32_t Pit::valueOf(const Channel& channel) const {
  return counts(channel) && !channel.chained()
             ? channel.reload - static_cast<std::uint32_t>(bus() - channel.loadedAt)
             : channel.value;
}

void Pit::start(Channel& channel) const {
  channel.reload = channel.load;
  channel.value = channel.load;
  channel.loadedAt = bus();
}

void Pit::update(std::size_t index) {
  const Channel& channel = channels_[index];
  board_.setLine(kFirstLine + static_cast<unsigned>(index),
                 channel.flag && (channel.control & kInterrupt) != 0);
}

// A channel can be chained to the previous channel. Therefore this function calls itself for the
// next channel, up to the last channel.
// NOLINTNEXTLINE(misc-no-recursion): at most one call for each channel
void Pit::expire(std::size_t index) {
  Channel& channel = channels_[index];
  channel.flag = true;
  channel.loadedAt += std::uint64_t{channel.reload} + 1;
  channel.reload = channel.load;
  channel.value = channel.load;
  update(index);
  if (index + 1 < channels_.size()) {
    Channel& next = channels_[index + 1];
    if (counts(next) && next.chained()) {
      if (next.value == 0) {
        expire(index + 1);
      } else {
        --next.value;
      }
    }
  }
}

Time Pit::nextEvent() const {
  Time next = kNever;
  for (const Channel& channel : channels_) {
    if (counts(channel) && !channel.chained()) {
      next = std::min(next,
                      board_.busClock().at(channel.loadedAt + std::uint64_t{channel.reload} + 1));
    }
  }
  return next;
}

void Pit::advance() {
  const std::uint64_t now = bus();
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const Channel& channel = channels_[i];
    while (counts(channel) && !channel.chained() &&
           now > channel.loadedAt + std::uint64_t{channel.reload}) {
      expire(i);
    }
  }
}

bool Pit::readHasEffect(std::uint32_t offset) const {
  return offset == kMcr;
}

std::uint32_t Pit::read(std::uint32_t offset, unsigned size) {
  if (!hasSize("PIT", offset, size, 4)) {
    return 0;
  }
  if (offset == kMcr) {
    controlRead_ = true;
    return control_;
  }
  if (offset < kFirstChannel || offset >= kEnd) {
    unmodelled("PIT", offset);
    return 0;
  }
  const Channel& channel = channels_[(offset - kFirstChannel) / 0x10];
  switch (offset & 0xFU) {
    case kLdval:
      return channel.load;
    case kCval:
      return valueOf(channel);
    case kTctrl:
      return channel.control;
    default:
      return channel.flag ? 1 : 0;
  }
}

void Pit::setControl(Channel& channel, std::uint32_t value) {
  const bool counted = counts(channel);
  channel.value = valueOf(channel);
  channel.control = value & 7U;
  if (counts(channel) && !counted) {
    start(channel);
  }
}

void Pit::setStopped(bool stopped) {
  for (Channel& channel : channels_) {
    channel.value = valueOf(channel);
  }
  control_ = stopped ? control_ | kStopped : control_ & ~kStopped;
  for (Channel& channel : channels_) {
    if (counts(channel) && !channel.chained()) {
      channel.loadedAt = bus() - (channel.reload - channel.value);
    }
  }
}

void Pit::write(std::uint32_t offset, unsigned size, std::uint32_t value) {
  if (!hasSize("PIT", offset, size, 4)) {
    return;
  }
  if (!controlRead_) {
    // According to the errata of the K64, a write immediately after the opening of the clock gate
    // may be lost. A read of MCR waits for the clock.
    misuse("the PIT was written after its clock gate was opened, but before MCR was read");
  }
  if (offset == kMcr) {
    if (((value ^ control_) & kStopped) != 0) {
      setStopped((value & kStopped) != 0);
    }
    control_ = (control_ & ~1U) | (value & 1U);
    return;
  }
  if (offset < kFirstChannel || offset >= kEnd) {
    unmodelled("PIT", offset);
    return;
  }
  if ((control_ & kStopped) != 0) {
    misuse("a channel of the PIT was set up while MCR.MDIS stopped the timers");
  }
  const std::size_t index = (offset - kFirstChannel) / 0x10;
  Channel& channel = channels_[index];
  switch (offset & 0xFU) {
    case kLdval:
      channel.load = value;  // takes effect at the next start or reload
      break;
    case kCval:
      misuse("store to the current value of a PIT channel");
      break;
    case kTctrl:
      if (index == 0 && (value & 4U) != 0) {
        misuse("PIT channel 0 cannot be chained");
      }
      setControl(channel, value);
      update(index);
      break;
    default:
      channel.flag = channel.flag && (value & 1U) == 0;  // TFLG.TIF is cleared by writing 1
      update(index);
      break;
  }
}

}  // namespace wr::emulator
