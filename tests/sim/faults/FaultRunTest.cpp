#include "sim/faults/FaultRun.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "k64/patch.hpp"
#include "sim/emulator/Image.hpp"
#include "sim/emulator/Symbols.hpp"
#include "sim/faults/InjectedFault.hpp"
#include "support/image.hpp"

namespace wr::test {

namespace {

using faults::FaultRun;
using faults::Kind;
using faults::Outcome;

constexpr int kAt = 3000;           // ms
constexpr std::uint64_t kSeed = 7;  // in the test drive with this seed, all wheels turn at kAt

constexpr std::uint32_t kAngleDrift = 9;  // number of this fault among the faults of sensors

class FaultRunTest : public testing::Test {
 protected:
  static std::filesystem::path elf() { return imageOf("weeding_robot").replace_extension(".elf"); }
  static std::vector<std::uint8_t> image() { return emulator::readImage(imageOf("weeding_robot")); }

  /// Returns the test drive without a fault. All tests use the same test drive.
  static FaultRun& drive() {
    static FaultRun run(image(), elf(), kSeed);
    return run;
  }

  static std::uint32_t functionOf(const std::filesystem::path& elf, const std::string& part) {
    const emulator::Symbols symbols(elf);
    const auto found = std::ranges::find_if(symbols.functions(), [&](const auto& function) {
      return function.name.find(part) != std::string::npos;
    });
    if (found == symbols.functions().end()) {
      throw std::runtime_error("the firmware image has no function " + part);
    }
    return found->address;
  }
};

std::vector<std::tuple<Kind, int, std::uint32_t, Outcome, int>> injected(FaultRun& drive,
                                                                         std::uint64_t seed) {
  std::vector<std::tuple<Kind, int, std::uint32_t, Outcome, int>> found;
  faults::Random random(seed);
  drive.injectAll(40, random, std::nullopt, [&](const faults::Result& result) {
    found.emplace_back(result.fault.kind, result.at, result.fault.place, result.verdict.outcome,
                       result.verdict.safeAfter);
  });
  return found;
}

}  // namespace

TEST_F(FaultRunTest, ABitOfErasedFlashIsHarmless) {
  const std::uint32_t behind = drive().places().flashEnd;
  EXPECT_EQ(drive().injectOne({Kind::Flash, behind, 0}, kAt).verdict.outcome, Outcome::Harmless);
}

TEST_F(FaultRunTest, AJumpToNowhereIsDetectedByAReset) {
  const auto result = drive().injectOne({Kind::Register, 15, 29}, kAt);
  EXPECT_EQ(result.verdict.outcome, Outcome::Detected);
  EXPECT_GE(result.verdict.safeAfter, 0);
  EXPECT_LE(result.verdict.safeAfter, 10);
}

// The firmware reports the drift when the error of the angle is 3 degrees. The outputs already
// count as wrong when the error is greater than 1 degree.
TEST_F(FaultRunTest, ADriftOfTheAngleIsReportedLate) {
  const auto result = drive().injectOne({Kind::Sensor, kAngleDrift, 0, 130}, kAt);
  EXPECT_EQ(result.verdict.outcome, Outcome::Late);
  EXPECT_GT(result.verdict.safeAfter, 1800);
  EXPECT_LT(result.verdict.safeAfter, 3000);
}

TEST_F(FaultRunTest, ADriftThatIsTooSlowToBeReportedInTheTimeOfObservationIsSilent) {
  const auto result = drive().injectOne({Kind::Sensor, kAngleDrift, 0, 35}, kAt);
  EXPECT_EQ(result.verdict.outcome, Outcome::Silent);
  EXPECT_GT(result.verdict.wrongFor, 0);
}

TEST_F(FaultRunTest, AnEncoderOfFramesThatFailsIsAHang) {
  const std::filesystem::path unchecked = imageOf("weeding_robot_paper");  // without ProgramCheck
  const auto elf = std::filesystem::path(unchecked).replace_extension(".elf");
  FaultRun unsafe(emulator::readImage(unchecked), elf, kSeed);
  const std::uint32_t encoder = functionOf(elf, "PcConnection4send");
  const auto hangs = [&](std::uint32_t offset) {
    return unsafe.injectOne({Kind::Code, encoder + offset, 2}, kAt).verdict.outcome ==
           Outcome::Hung;
  };
  const std::vector<std::uint32_t> odd{41, 51, 61, 71, 81, 91, 101, 111, 119, 121, 123, 125};
  EXPECT_TRUE(std::ranges::any_of(odd, hangs));
}

TEST_F(FaultRunTest, ALostClockIsDetectedAndSafe) {
  constexpr std::uint32_t kNoClock = 1;
  const auto result = drive().injectOne({Kind::Clock, kNoClock}, kAt);
  EXPECT_EQ(result.verdict.outcome, Outcome::Detected);
  EXPECT_LE(result.verdict.safeAfter, faults::kSafeWithin);
}

TEST_F(FaultRunTest, APowerCycleIsDetectedAtOnce) {
  for (const std::uint32_t cause : {0U, 1U, 2U}) {
    const auto result = drive().injectOne({Kind::Supply, cause}, kAt);
    EXPECT_EQ(result.verdict.outcome, Outcome::Detected);
    EXPECT_EQ(result.verdict.safeAfter, 0);
  }
}

TEST_F(FaultRunTest, AFaultOfOneCopyIsNotInTheNext) {
  const std::uint32_t behind = drive().places().flashEnd;
  static_cast<void>(drive().injectOne({Kind::Supply, 1}, kAt));
  EXPECT_EQ(drive().injectOne({Kind::Flash, behind, 0}, kAt).verdict.outcome, Outcome::Harmless);
}

TEST_F(FaultRunTest, TheSameSeedsGiveTheSameResults) {
  FaultRun again(image(), elf(), kSeed);
  const auto first = injected(drive(), 5);
  EXPECT_EQ(first, injected(again, 5));
  EXPECT_NE(first, injected(again, 6));
}

TEST_F(FaultRunTest, ARandomCampaignHasMoreThanOneClassAndKind) {
  std::set<Kind> kinds;
  std::set<Outcome> outcomes;
  for (const auto& [kind, at, place, outcome, after] : injected(drive(), 5)) {
    EXPECT_GE(at, FaultRun::kFirst);
    EXPECT_LE(
        at, FaultRun::kLast + 102);  // the injection may wait until 2 ms after the next clock pulse
    kinds.insert(kind);
    outcomes.insert(outcome);
  }
  EXPECT_GT(kinds.size(), 4U);
  EXPECT_GT(outcomes.size(), 1U);
}

// The handler returns without clearing the flag of its timer, and therefore the interrupt repeats
// without end.
TEST_F(FaultRunTest, AnInterruptThatForgetsItsFlagIsFoundWithoutAFault) {
  const Code forgets{0x4770};  // bx lr
  EXPECT_THROW(FaultRun(withHandler(image(), kPulseException, forgets), elf(), kSeed),
               std::runtime_error);
}

}  // namespace wr::test
