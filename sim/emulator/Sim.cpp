#include "sim/emulator/Sim.hpp"

#include <initializer_list>

namespace wr::emulator {

namespace {

// Offsets from 0x40047000 (K64P144M120SF5RM, SIM memory map).
constexpr std::uint32_t kSopt1 = 0x0000;
constexpr std::uint32_t kSopt2 = 0x1004;
constexpr std::uint32_t kSopt4 = 0x100C;
constexpr std::uint32_t kSopt5 = 0x1010;
constexpr std::uint32_t kSopt7 = 0x1018;
constexpr std::uint32_t kSdid = 0x1024;
constexpr std::uint32_t kScgc1 = 0x1028;
constexpr std::uint32_t kScgc7 = 0x1040;
constexpr std::uint32_t kClkdiv1 = 0x1044;
constexpr std::uint32_t kClkdiv2 = 0x1048;
constexpr std::uint32_t kUidh = 0x1054;
constexpr std::uint32_t kUidl = 0x1060;

// The offsets of the registers SOPT1, SOPT2, SOPT4, SOPT5, SOPT7 and CLKDIV2, and their values
// after a reset.
constexpr std::array<std::uint32_t, 6> kOptionOffsets{kSopt1, kSopt2, kSopt4,
                                                      kSopt5, kSopt7, kClkdiv2};
constexpr std::array<std::uint32_t, 6> kOptionsAtReset{0x80000000, 0x00001000, 0, 0, 0, 0};

// SCGC1 to SCGC7 after a reset.
constexpr std::array<std::uint32_t, 8> kGatesAtReset{
    0, 0, 0, 0, 0xF0100030, 0x00040182, 0x40000001, 0x00000006};
constexpr std::uint32_t bits(std::initializer_list<unsigned> places) {
  std::uint32_t mask = 0;
  for (const unsigned place : places) {
    mask |= 1U << place;
  }
  return mask;
}

// The bits of SCGC1, SCGC2, SCGC3, SCGC4, SCGC5, SCGC6 and SCGC7 that are clock gates.
constexpr std::array<std::uint32_t, 8> kGates{
    0,
    bits({6, 7, 10, 11}),
    bits({0, 12, 13}),
    bits({0, 12, 17, 24, 25, 27}),
    bits({1, 2, 6, 7, 10, 11, 12, 13, 18, 19, 20}),
    bits({0, 9, 10, 11, 12, 13}),
    bits({0, 1, 4, 9, 12, 13, 15, 18, 21, 22, 23, 24, 25, 26, 27, 29, 31}),
    bits({0, 1, 2})};

}  // namespace

void Sim::reset(Reset /*cause*/) {
  gates_ = kGatesAtReset;
  options_ = kOptionsAtReset;
  dividers_ = fastBoot_ ? 0x00110000 : 0x77FF0000;
}

std::uint32_t Sim::read(std::uint32_t offset, unsigned size) {
  if (!hasSize("SIM", offset, size, 4)) {
    return 0;
  }
  for (std::size_t i = 0; i < kOptionOffsets.size(); ++i) {
    if (kOptionOffsets[i] == offset) {
      return options_[i];
    }
  }
  if (offset >= kScgc1 && offset <= kScgc7) {
    return gates_[1 + (offset - kScgc1) / 4];
  }
  if (offset == kClkdiv1) {
    return dividers_;
  }
  if (offset == kSdid) {
    return 0x014C8A2A;  // K64, 100 pins
  }
  if (offset >= kUidh && offset <= kUidl) {
    return 0x57524B00 + offset;
  }
  unmodelled("SIM", offset);
  return 0;
}

void Sim::write(std::uint32_t offset, unsigned size, std::uint32_t value) {
  if (!hasSize("SIM", offset, size, 4)) {
    return;
  }
  for (std::size_t i = 0; i < kOptionOffsets.size(); ++i) {
    if (kOptionOffsets[i] == offset) {
      options_[i] = value;
      return;
    }
  }
  if (offset >= kScgc1 && offset <= kScgc7) {
    const std::size_t group = 1 + (offset - kScgc1) / 4;
    gates_[group] = (kGatesAtReset[group] & ~kGates[group]) | (value & kGates[group]);
  } else if (offset == kClkdiv1) {
    dividers_ = value & 0xFFFF0000U;
    board_.clocksChanged();
  } else {
    unmodelled("SIM", offset);
  }
}

bool Sim::gateIsOpen(unsigned group, unsigned bit) const {
  return (gates_[group] >> bit & 1U) != 0;
}

Sim::Dividers Sim::dividers() const {
  return {(dividers_ >> 28) + 1, (dividers_ >> 24 & 0xFU) + 1, (dividers_ >> 20 & 0xFU) + 1,
          (dividers_ >> 16 & 0xFU) + 1};
}

}  // namespace wr::emulator
