#include "sim/programs/Pace.hpp"

#include <thread>
#include <utility>

namespace wr::programs {

Pace::Pace(std::function<Clock::time_point()> now,
           std::function<void(Clock::time_point)> sleepUntil)
    : now_(std::move(now)), sleepUntil_(std::move(sleepUntil)), start_(now_()) {}

void Pace::waitFor(Clock::duration time) {
  const Clock::duration late = now_() - (start_ + lost_ + time);
  if (late > kLate) {
    lost_ += late;
  } else if (late < Clock::duration::zero()) {
    sleepUntil_(start_ + lost_ + time);
  }
}

void Pace::sleep(Clock::time_point until) {
  std::this_thread::sleep_until(until);
}

void printLost(const Pace& pace, std::FILE* output) {
  const auto lost = std::chrono::duration_cast<std::chrono::milliseconds>(pace.lost());
  if (lost.count() > 0) {
    std::fprintf(output,
                 "This computer was too slow. The robot's time did not advance for %lld ms.\n",
                 static_cast<long long>(lost.count()));
  }
}

}  // namespace wr::programs
