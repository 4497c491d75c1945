#include "sim/emulator/Ftm.hpp"

#include <algorithm>
#include <utility>

namespace wr::emulator {

namespace {

// Offsets from the base of a timer (K64P144M120SF5RM, FTM memory map).
constexpr std::uint32_t kSc = 0x00;
constexpr std::uint32_t kCnt = 0x04;
constexpr std::uint32_t kMod = 0x08;
constexpr std::uint32_t kFirstChannel = 0x0C;
constexpr std::uint32_t kChannelSize = 0x08;
constexpr std::uint32_t kCntin = 0x4C;
constexpr std::uint32_t kStatus = 0x50;
constexpr std::uint32_t kMode = 0x54;
constexpr std::uint32_t kFms = 0x74;
constexpr std::uint32_t kConf = 0x84;
constexpr std::uint32_t kEnd = 0x9C;

// SC
constexpr std::uint32_t kClockAndPrescaler = 0x1F;
constexpr std::uint32_t kCenterAligned = 1U << 5;
constexpr std::uint32_t kInterrupt = 1U << 6;
constexpr std::uint32_t kOverflow = 1U << 7;
// CnSC
constexpr std::uint32_t kLowTrue = 1U << 2;  // ELSA
constexpr std::uint32_t kEdges = 3U << 2;    // ELSB, ELSA
constexpr std::uint32_t kPwm = 1U << 5;      // MSB
constexpr std::uint32_t kModes = 0xF << 2;   // MSB, MSA, ELSB, ELSA
// MODE and FMS
constexpr std::uint32_t kProtectionOff = 1U << 2;
constexpr std::uint32_t kProtectionOn = 1U << 6;
// CONF.BDMMODE
constexpr std::uint32_t kInDebug = 3U << 6;

constexpr std::uint32_t kMillion = 1'000'000;

}  // namespace

Ftm::Ftm(Microcontroller& board, unsigned number, unsigned channels)
    : Peripheral(board),
      number_(number),
      channelCount_(channels),
      name_("FTM" + std::to_string(number)) {}

void Ftm::connectPins(std::function<bool(unsigned)> connected) {
  connected_ = std::move(connected);
}

void Ftm::reset(Reset /*cause*/) {
  for (Channel& channel : channels_) {
    channel = {.shown = channel.shown};
  }
  control_ = 0;
  modulo_ = 0;
  moduloWritten_.reset();
  configuration_ = 0;
  protectionOff_ = true;
  protectionSeen_ = false;
  held_ = 0;
  overflowsBefore_ = 0;
  overflowsSeen_ = 0;
  flagRead_ = false;
  waits_ = false;
  show();
}

// Returns the number of bus clock cycles from one overflow to the next.
std::uint64_t Ftm::length() const {
  return std::uint64_t{period()} << (control_ & 7U);
}

std::uint64_t Ftm::overflows() const {
  return overflowsBefore_ + (counts() ? (bus() - from_) / length() : 0);
}

std::uint32_t Ftm::counter() const {
  return counts() ? static_cast<std::uint32_t>((bus() - from_) % length() >> (control_ & 7U))
                  : held_;
}

void Ftm::startFrom(std::uint32_t value) {
  from_ = bus() - (std::uint64_t{value} << (control_ & 7U));
}

// In each period, the output of a channel is high for a number of counts. Returns this number.
std::uint32_t Ftm::high(const Channel& channel) const {
  if ((channel.control & kPwm) == 0 || (channel.control & kEdges) == 0) {
    return 0;
  }
  const std::uint32_t width = std::min(channel.value, period());
  return (channel.control & kLowTrue) != 0 ? period() - width : width;
}

double Ftm::duty(unsigned channel) const {
  if (!counts() || channel >= channelCount_ || !connected_(channel)) {
    return 0;
  }
  return static_cast<double>(high(channels_[channel])) / period();
}

void Ftm::show() {
  for (unsigned i = 0; i < channelCount_; ++i) {
    Channel& channel = channels_[i];
    const bool shows = counts() && high(channel) != 0 && connected_(i);
    const std::uint32_t share =
        shows ? static_cast<std::uint32_t>(std::uint64_t{high(channel)} * kMillion / period()) : 0;
    if (std::exchange(channel.shown, share) != share) {
      board_.tell(Event::Kind::PwmChanged, 8 * number_ + i, share);
    }
  }
}

// Returns true if the write protection prevents a change of a field. Also reports the prevented
// change as a finding.
bool Ftm::isProtected(std::uint32_t before, std::uint32_t after, const char* what) {
  if (protectionOff_ || before == after) {
    return false;
  }
  misuse(name_ + "_" + what + " was written while MODE.WPDIS was 0");
  return true;
}

Ftm::Channel* Ftm::channelAt(std::uint32_t offset) {
  const std::uint32_t end = kFirstChannel + channelCount_ * kChannelSize;
  return offset >= kFirstChannel && offset < end
             ? &channels_[(offset - kFirstChannel) / kChannelSize]
             : nullptr;
}

// While the counter runs, a value that is written to MOD or CnV waits. It takes effect when the
// counter restarts at 0.
void Ftm::waitForOverflow() {
  if (!waits_) {
    waits_ = true;
    takesAt_ = from_ + ((bus() - from_) / length() + 1) * length();
  }
}

void Ftm::takeWritten() {
  waits_ = false;
  modulo_ = std::exchange(moduloWritten_, std::nullopt).value_or(modulo_);
  for (Channel& channel : channels_) {
    channel.value = std::exchange(channel.written, std::nullopt).value_or(channel.value);
  }
  checkValues();
  show();
}

// If the value of a channel is MOD + 1, its pin stays high. A greater value is a misuse.
void Ftm::checkValues() {
  for (const Channel& channel : channels_) {
    if (counts() && (channel.control & kPwm) != 0 && channel.value > period()) {
      misuse(name_ + ": a channel's value of " + std::to_string(channel.value) +
             " is beyond the period of " + std::to_string(period()));
    }
  }
}

Time Ftm::nextEvent() const {
  return waits_ ? board_.busClock().at(takesAt_) : kNever;
}

void Ftm::advance() {
  if (waits_ && bus() >= takesAt_) {
    overflowsBefore_ += (takesAt_ - from_) / length();
    from_ = takesAt_;
    takeWritten();
  }
}

std::uint32_t Ftm::readStatus() {
  const bool flag = overflows() != overflowsSeen_;
  flagRead_ = flag;
  return control_ | (flag ? kOverflow : 0);
}

bool Ftm::readHasEffect(std::uint32_t offset) const {
  return offset == kSc || offset == kFms;
}

std::uint32_t Ftm::read(std::uint32_t offset, unsigned size) {
  if (!hasSize(name_, offset, size, 4)) {
    return 0;
  }
  if (const Channel* channel = channelAt(offset); channel != nullptr) {
    return (offset - kFirstChannel) % kChannelSize == 0 ? channel->control : channel->value;
  }
  switch (offset) {
    case kSc:
      return readStatus();
    case kCnt:
      return counter();
    case kMod:
      return modulo_;
    case kMode:
      return protectionOff_ ? kProtectionOff : 0;
    case kFms:
      protectionSeen_ = !protectionOff_;
      return protectionOff_ ? 0 : kProtectionOn;
    case kConf:
      return configuration_;
    default:
      if (offset < kCntin || offset >= kEnd || offset == kStatus) {
        unmodelled(name_, offset);
      }
      return 0;
  }
}

void Ftm::setStatus(std::uint32_t value) {
  const std::uint32_t wanted = value & kClockAndPrescaler;
  if ((value & (kCenterAligned | kInterrupt)) != 0) {
    unmodelled(name_ + "_SC with CPWMS or TOIE", kSc);
  }
  if ((wanted >> 3 & 3U) > 1) {
    unmodelled(name_ + "_SC with another clock than the bus clock", kSc);
  }
  if (isProtected(control_ & kClockAndPrescaler, wanted, "SC")) {
    return;
  }
  if (std::exchange(flagRead_, false) && (value & kOverflow) == 0) {
    overflowsSeen_ = overflows();
  }
  if (wanted == control_) {
    return;
  }
  overflowsBefore_ = overflows();
  held_ = counter();
  control_ = wanted;
  startFrom(held_);
  if (waits_) {
    takeWritten();
  } else {
    checkValues();
    show();
  }
}

void Ftm::setMode(std::uint32_t value) {
  if ((value & ~kProtectionOff) != 0) {
    unmodelled(name_ + "_MODE with more than WPDIS", kMode);
  }
  // Writing 1 sets WPDIS if FMS.WPEN was read as 1 before. Writing 0 has no effect.
  if ((value & kProtectionOff) != 0 && std::exchange(protectionSeen_, false)) {
    protectionOff_ = true;
  }
}

void Ftm::setChannel(Channel& channel, std::uint32_t value) {
  const bool off = (value & kModes) == 0;
  const bool pwm = (value & kPwm) != 0 && (value & kEdges) != 0;
  if ((!off && !pwm) || (value & ~kModes & 0x7FU) != 0) {
    unmodelled(name_ + "_CnSC other than edge-aligned PWM", kFirstChannel);
  }
  if (!isProtected(channel.control, value & kModes, "CnSC")) {
    channel.control = value & kModes;
    checkValues();
    show();
  }
}

void Ftm::write(std::uint32_t offset, unsigned size, std::uint32_t value) {
  if (!hasSize(name_, offset, size, 4)) {
    return;
  }
  if (Channel* channel = channelAt(offset); channel != nullptr) {
    if ((offset - kFirstChannel) % kChannelSize == 0) {
      setChannel(*channel, value);
    } else {
      channel->written = value & 0xFFFFU;
      counts() ? waitForOverflow() : takeWritten();
    }
    return;
  }
  switch (offset) {
    case kSc:
      setStatus(value);
      break;
    case kCnt:  // writing any value sets the counter to 0
      overflowsBefore_ = overflows();
      held_ = 0;
      startFrom(0);
      if (std::exchange(waits_, false)) {
        waitForOverflow();
      }
      break;
    case kMod:
      moduloWritten_ = value & 0xFFFFU;
      counts() ? waitForOverflow() : takeWritten();
      break;
    case kMode:
      setMode(value);
      break;
    case kFms:
      protectionOff_ = protectionOff_ && (value & kProtectionOn) == 0;
      break;
    case kConf:
      if ((value & ~kInDebug) != 0) {
        unmodelled(name_ + "_CONF with more than BDMMODE", offset);
      }
      configuration_ = value & kInDebug;
      break;
    default:
      if (offset < kCntin || offset >= kEnd || offset == kStatus || value != 0) {
        unmodelled(name_, offset);
      }
      break;
  }
}

}  // namespace wr::emulator
