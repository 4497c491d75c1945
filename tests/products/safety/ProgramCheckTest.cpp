#include "safety/ProgramCheck.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <vector>

namespace wr::test {
namespace {

using Words = ProgramCheck::Words;

constexpr std::size_t kSizeOfRam = std::size_t{64} * 1024 / sizeof(Words);

/// A stored program of two parts, and its copy in RAM.
class CheckedProgram : public testing::Test {
 protected:
  // Runs a number of ticks. Calls the check after each tick, and also after other interrupts
  // between two ticks.
  void ticks(int count) {
    for (int number = 0; number < count; ++number) {
      check_.tick();
      check_.step();
      check_.step();
    }
  }

  void step() { check_.step(); }

  std::vector<Words> original_ = std::vector<Words>(kSizeOfRam, {1, 2, 3, 0xFFFFFFF0U});
  std::vector<Words> copy_ = original_;

 private:
  std::size_t half_ = original_.size() / 2 + 5;
  std::array<ProgramCheck::Part, 2> parts_{
      ProgramCheck::Part{.original = std::span(original_).first(half_),
                         .copy = std::span(copy_).first(half_)},
      ProgramCheck::Part{.original = std::span(original_).subspan(half_),
                         .copy = std::span(copy_).subspan(half_)}};
  ProgramCheck check_{parts_};
};

/// @brief If the copy does not change, the check finds no fault in 10000 ticks.
/// @verifies FR-309
TEST_F(CheckedProgram, FR309_AnUnchangedProgramGoesOn) {
  ticks(10'000);
}

using CheckedProgramDeathTest = CheckedProgram;

/// @brief The copy of the program fills the lower RAM. If a bit of the copy changes, an assertion
/// fails within 300 ticks (0.3 s). The test changes four bits at each of three places: at the
/// beginning of the copy, after its first third, and at its end.
/// @verifies FR-309
TEST_F(CheckedProgramDeathTest, FR309_AChangedBitEndsTheProgram) {
  ticks(200);
  for (const std::size_t place : {std::size_t{0}, kSizeOfRam / 3, kSizeOfRam - 1}) {
    for (const unsigned bit : {0U, 17U, 30U, 31U}) {
      std::uint32_t& word = copy_[place].at(bit % 4);
      word ^= 1U << bit;
      EXPECT_DEATH(ticks(300), "assertion 8 failed") << place << " " << bit;
      word ^= 1U << bit;
    }
  }
}

/// @brief Without a tick, the program is not checked, even when the processor wakes often: a
/// changed bit is not detected.
/// @verifies FR-309
TEST_F(CheckedProgram, FR309_WithoutATickNothingIsChecked) {
  copy_.front().front() ^= 1U;
  for (int number = 0; number < 10'000; ++number) {
    step();
  }
}

/// @brief Each tick permits one step of the check. If the processor wakes 10000 times after a tick,
/// only the first step adds words to the sum: the check does not reach the end of the program, and
/// a changed bit is not detected.
/// @verifies FR-309
TEST_F(CheckedProgram, FR309_EachTickPermitsOneStep) {
  copy_.front().front() ^= 1U;
  ticks(1);
  for (int number = 0; number < 10'000; ++number) {
    step();
  }
}

}  // namespace
}  // namespace wr::test
