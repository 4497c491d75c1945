#include "sim/plant/Noise.hpp"

namespace wr::plant {

namespace {

constexpr int kSummed = 12;
constexpr double kHalf = 2147483648.0;  // 2^31

// Returns the result of the mixing function of the generator SplitMix64.
std::uint64_t mixed(std::uint64_t value) {
  value += 0x9E3779B97F4A7C15U;
  value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9U;
  value = (value ^ (value >> 27U)) * 0x94D049BB133111EBU;
  return value ^ (value >> 31U);
}

}  // namespace

double Noise::uniform(std::uint32_t source, std::uint64_t index) const {
  const std::uint64_t bits = mixed(mixed(seed_ << 32U | source) + index);
  return static_cast<double>(bits >> 32U) / kHalf - 1.0;
}

double Noise::normal(std::uint32_t source, std::uint64_t index) const {
  double sum = 0;
  for (std::uint64_t i = 0; i < kSummed; ++i) {
    sum += uniform(source, index * kSummed + i);
  }
  return sum / 2;  // the variance of each number is 1/3, so the variance of their sum is 4
}

}  // namespace wr::plant
