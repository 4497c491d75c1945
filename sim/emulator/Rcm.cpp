#include "sim/emulator/Rcm.hpp"

namespace wr::emulator {

namespace {

// Offsets from 0x4007F000 (K64P144M120SF5RM, RCM memory map).
constexpr std::uint32_t kSrs0 = 0;
constexpr std::uint32_t kSrs1 = 1;
constexpr std::uint32_t kRpfc = 4;
constexpr std::uint32_t kRpfw = 5;
constexpr std::uint32_t kMr = 7;

}  // namespace

void Rcm::reset(Reset cause) {
  // Sets RCM_SRS0 and RCM_SRS1. After power-on, both POR and LVD are set.
  switch (cause) {
    case Reset::PowerOn:
      registers_ = {0x82, 0x00};
      break;
    case Reset::LowVoltage:
      registers_ = {0x02, 0x00};
      break;
    case Reset::Pin:
      registers_ = {0x40, 0x00};
      break;
    case Reset::Watchdog:
      registers_ = {0x20, 0x00};
      break;
    case Reset::ClockLost:
      registers_ = {0x04, 0x00};
      break;
    case Reset::LockLost:
      registers_ = {0x08, 0x00};
      break;
    case Reset::Lockup:
      registers_ = {0x00, 0x02};
      break;
    case Reset::Software:
      registers_ = {0x00, 0x04};
      break;
  }
}

std::uint32_t Rcm::read(std::uint32_t offset, unsigned size) {
  if (!hasSize("RCM", offset, size, 1)) {
    return 0;
  }
  if (offset <= kSrs1 || offset == kRpfc || offset == kRpfw || offset == kMr) {
    return registers_[offset];
  }
  unmodelled("RCM", offset);
  return 0;
}

void Rcm::write(std::uint32_t offset, unsigned size, std::uint32_t value) {
  if (!hasSize("RCM", offset, size, 1)) {
    return;
  }
  if (offset == kRpfc || offset == kRpfw) {
    registers_[offset] = value;
  } else if (offset == kSrs0 || offset == kSrs1 || offset == kMr) {
    misuse("store to a read-only register of the RCM");
  } else {
    unmodelled("RCM", offset);
  }
}

}  // namespace wr::emulator
