#include "sim/faults/Verdict.hpp"

#include <algorithm>
#include <cmath>

namespace wr::faults {

namespace {

bool differs(const Outputs& faulty, const Outputs& reference) {
  for (std::size_t wheel = 0; wheel < faulty.drive.size(); ++wheel) {
    if (std::abs(faulty.drive.at(wheel) - reference.drive.at(wheel)) > kWrongDrive) {
      return true;
    }
  }
  return std::abs(faulty.steering - reference.steering) > kWrongAngle;
}

struct Wrong {
  int before = 0;  // the part of `total` until the detection of the fault
  int total = 0;   // ms with wrong outputs; periods of at most kShort ms do not count
  int after = 0;   // ms with voltage at a wheel or with a moved steering, after a reset
};

// Before a reset, an output is counted as wrong only while a wheel has voltage, because the robot
// is safe without voltage. After a reset, the outputs are wrong if a wheel has voltage, or if the
// steering has moved since the reset.
Wrong countWrong(const Observation& faulty, const Outputs* reference, int detectedAt) {
  Wrong wrong;
  int run = 0;
  const auto resetAt = static_cast<std::size_t>(std::max(faulty.resetAt, 0));
  const auto end = static_cast<int>(faulty.outputs.size());
  for (int ms = 0; ms != end; ++ms) {
    const Outputs& now = faulty.outputs[static_cast<std::size_t>(ms)];
    if (faulty.resetAt != Observation::kNever && ms > faulty.resetAt) {
      const float moved = now.steering - faulty.outputs.at(resetAt).steering;
      wrong.after += now.wheelsOff() && std::abs(moved) <= kWrongAngle ? 0 : 1;
      continue;
    }
    run = differs(now, reference[ms]) && !now.wheelsOff() ? run + 1 : 0;
    if (run <= kShort) {
      continue;
    }
    const int added = run == kShort + 1 ? run : 1;
    wrong.total += added;
    wrong.before += detectedAt == Observation::kNever || ms <= detectedAt ? added : 0;
  }
  return wrong;
}

int firstOf(int a, int b) {
  if (a == Observation::kNever || b == Observation::kNever) {
    return std::max(a, b);
  }
  return std::min(a, b);
}

}  // namespace

std::string_view nameOf(Outcome outcome) {
  constexpr std::array<std::string_view, 6> kNames{"harmless", "detected", "late",
                                                   "silent",   "hung",     "stopped"};
  return kNames.at(static_cast<std::size_t>(outcome));
}

Verdict judge(const Observation& faulty, const Outputs* reference) {
  const int detectedAt = firstOf(faulty.resetAt, faulty.reportedAt);
  const Wrong wrong = countWrong(faulty, reference, detectedAt);
  Verdict verdict{.safeAfter = detectedAt, .wrongFor = wrong.total + wrong.after};
  if (detectedAt != Observation::kNever) {
    verdict.outcome =
        wrong.before > kSafeWithin || wrong.after > 0 ? Outcome::Late : Outcome::Detected;
  } else if (!faulty.answers) {
    verdict.outcome = Outcome::Hung;
  } else if (wrong.total > 0) {
    verdict.outcome = Outcome::Silent;
  }
  return verdict;
}

}  // namespace wr::faults
