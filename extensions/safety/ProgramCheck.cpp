#include "safety/ProgramCheck.hpp"

#include <algorithm>

#include "services/SystemConstants.hpp"
#include "services/assertion.hpp"

namespace wr {

namespace {

// Greatest size of a program in which each changed bit is found within kTimeToFind [groups of four
// words].
constexpr std::size_t kMaxWords = std::size_t{64} * 1024 / sizeof(ProgramCheck::Words);

// Time in which a changed bit is found.
constexpr Microseconds kTimeToFind = milliseconds(300);

// Number of steps for the sum of the whole program. Each tick permits one step. If a bit changes
// after its word was added to the present sum, only the next sum shows this change. Therefore two
// sums must fit into kTimeToFind. One tick of each sum is a reserve.
constexpr std::size_t kStepsOfSum =
    kTimeToFind.count() / (2 * SystemConstants::instance().tickPeriod().count()) - 1;

// Size of a step, in groups of four words.
constexpr std::size_t kWordsOfStep = (kMaxWords + kStepsOfSum - 1) / kStepsOfSum;

// This function is not inlined. In a separate function, all values of the loop are in registers of
// the core.
[[gnu::noinline]] std::uint32_t sumOf(std::span<const ProgramCheck::Words> words) {
  std::uint32_t sum = 0;
  for (const ProgramCheck::Words& four : words) {
    sum += four[0] + four[1] + four[2] + four[3];
  }
  return sum;
}

}  // namespace

void ProgramCheck::step() {
  if (!due_.load(std::memory_order_relaxed)) {
    return;
  }
  due_.store(false, std::memory_order_relaxed);
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
