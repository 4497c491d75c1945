#include "sim/emulator/Rnga.hpp"

namespace wr::emulator {

namespace {

// Offsets from 0x40029000 (K64P144M120SF5RM, RNGA memory map).
constexpr std::uint32_t kControl = 0x0;  // CR
constexpr std::uint32_t kStatus = 0x4;   // SR
constexpr std::uint32_t kEntropy = 0x8;
constexpr std::uint32_t kOutput = 0xC;  // OR

constexpr std::uint32_t kGo = 1;
constexpr std::uint32_t kWritable = 0x17;  // GO, HA, INTM, SLP; CLRI reads as 0
constexpr std::uint32_t kUnderflow = 4;    // SR.ORU
constexpr std::uint32_t kOneWord = 0x100;  // SR.OREG_LVL
constexpr std::uint32_t kSize = 0x10000;   // SR.OREG_SIZE: one word
constexpr std::uint64_t kClocksOfAWord = 256;

constexpr std::uint64_t kSeed = 0x524E4741;

}  // namespace

void Rnga::reset(Reset /*cause*/) {
  control_ = 0;
  underflow_ = false;
}

// Returns the upper half of the next number of the generator SplitMix64 (G. Steele, D. Lea, C.
// Flood, 2014).
std::uint32_t Rnga::draw() {
  ++drawn_;
  std::uint64_t word = kSeed + drawn_ * 0x9E3779B97F4A7C15;
  word = (word ^ word >> 30) * 0xBF58476D1CE4E5B9;
  word = (word ^ word >> 27) * 0x94D049BB133111EB;
  word ^= word >> 31;
  return static_cast<std::uint32_t>(word >> 32);
}

bool Rnga::wordIsReady() const {
  return (control_ & kGo) != 0 && board_.busClock().count(board_.time()) - since_ >= kClocksOfAWord;
}

bool Rnga::readHasEffect(std::uint32_t offset) const {
  return offset == kOutput;
}

std::uint32_t Rnga::read(std::uint32_t offset, unsigned size) {
  if (!hasSize("RNG", offset, size, 4)) {
    return 0;
  }
  switch (offset) {
    case kControl:
      return control_;
    case kStatus:
      return kSize | (wordIsReady() ? kOneWord : 0) | (underflow_ ? kUnderflow : 0);
    case kEntropy:
      return 0;
    case kOutput:
      if (!wordIsReady()) {
        underflow_ = true;
        return 0;
      }
      since_ = board_.busClock().count(board_.time());
      return draw();
    default:
      unmodelled("RNG", offset);
      return 0;
  }
}

void Rnga::write(std::uint32_t offset, unsigned size, std::uint32_t value) {
  if (!hasSize("RNG", offset, size, 4)) {
    return;
  }
  if (offset == kControl) {
    if ((value & kGo) != 0 && (control_ & kGo) == 0) {
      since_ = board_.busClock().count(board_.time());
    }
    control_ = value & kWritable;
  } else if (offset == kStatus || offset == kOutput) {
    misuse("store to a read-only register of the RNG");
  } else if (offset != kEntropy) {
    unmodelled("RNG", offset);
  }
}

}  // namespace wr::emulator
