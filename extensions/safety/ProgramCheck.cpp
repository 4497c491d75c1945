#include "safety/ProgramCheck.hpp"

#include <algorithm>

#include "services/assertion.hpp"

namespace wr {

namespace {

// Size of a step, in groups of four words. With one step in each tick, the sum of a program of 64
// KiB is complete after 147 ms. A changed bit is found when the present sum or the next sum is
// complete.
constexpr std::size_t kWordsOfStep = 28;

std::uint32_t sumOf(std::span<const ProgramCheck::Words> words) {
  std::uint32_t sum = 0;
  for (const ProgramCheck::Words& four : words) {
    sum += four[0] + four[1] + four[2] + four[3];
  }
  return sum;
}

}  // namespace

void ProgramCheck::step() {
  if (!due_.exchange(false, std::memory_order_relaxed)) {
    return;
  }
  const auto [original, copy] = parts_[part_];
  const std::size_t count = std::min(kWordsOfStep, copy.size() - next_);
  sum_ += sumOf(copy.subspan(next_, count));
  if (!originalKnown_) {
    original_ += sumOf(original.subspan(next_, count));
  }
  next_ += count;
  if (next_ != copy.size()) {
    return;
  }
  next_ = 0;
  ++part_;
  if (part_ == parts_.size()) {
    originalKnown_ = true;
    require(sum_ == original_, AssertId::ProgramChanged);
    part_ = 0;
    sum_ = 0;
  }
}

}  // namespace wr
